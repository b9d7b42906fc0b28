import CKernels
import Foundation
import Synchronization
import SceneModel

/// Carries progress out of kernels and the wish to cancel into them.
///
/// Kernels call back from their own threads, where `Task.isCancelled` says nothing; hence the flag.
package final class KernelControl: Sendable {
  /// Receives the fraction done, 0…1, from any thread.
  package typealias ProgressHandler = @Sendable (Double) -> Void

  /// Threads that kernels may use, at least 1. Results do not depend on it.
  package let threadCount: Int
  private let flag: CancellationFlag
  private let onProgress: ProgressHandler?

  package init(
    threadCount: Int = 1, flag: CancellationFlag = CancellationFlag(),
    onProgress: ProgressHandler? = nil
  ) {
    self.threadCount = max(1, threadCount)
    self.flag = flag
    self.onProgress = onProgress
  }

  package var isCancelled: Bool { flag.isCancelled }

  /// Reports progress; throws `CancellationError` when the run is to stop.
  package func step(_ fraction: Double) throws {
    onProgress?(fraction)
    if isCancelled { throw CancellationError() }
  }

  /// The control of a part of the work that runs from `start` to `end` of this control's progress.
  package func part(from start: Double, to end: Double) -> KernelControl {
    KernelControl(threadCount: threadCount, flag: flag) { [onProgress] fraction in
      onProgress?(start + (end - start) * fraction)
    }
  }

  /// A control for each of `count` units of work that run at once; this control hears of their sum.
  func units(_ count: Int) -> [KernelControl] {
    let progress = UnitProgress(count)
    return (0..<count).map { unit in
      KernelControl(threadCount: threadCount, flag: flag) { [onProgress] fraction in
        onProgress?(progress.report(fraction, of: unit))
      }
    }
  }

  /// The control without anybody who hears of progress.
  var silent: KernelControl { KernelControl(threadCount: threadCount, flag: flag) }

  fileprivate func shouldContinue(at fraction: Double) -> Bool {
    onProgress?(fraction)
    return !isCancelled
  }
}

/// How far each of several units of work is.
private final class UnitProgress: Sendable {
  private let fractions: Locked<(units: [Double], sum: Double)>

  init(_ count: Int) {
    fractions = Locked((units: [Double](repeating: 0, count: count), sum: 0))
  }

  /// Takes a unit's fraction in and returns that of all.
  func report(_ fraction: Double, of unit: Int) -> Double {
    fractions.withLock { state in
      let step = max(0, min(1, fraction) - state.units[unit])
      state.units[unit] += step
      state.sum += step
      return state.sum / Double(state.units.count)
    }
  }
}

/// A flag that says once and for all that a run is to stop.
package final class CancellationFlag: Sendable {
  private let value = Atomic<Bool>(false)

  package init() {}

  package var isCancelled: Bool { value.load(ordering: .relaxed) }

  package func cancel() { value.store(true, ordering: .relaxed) }
}

/// A kernel that did not end well, in its own words.
package enum KernelError: LocalizedError, Equatable, CustomStringConvertible {
  case invalidArgument(String)
  /// The input is valid but does not determine a result.
  case degenerate(String)
  case failed(String)
  /// There was too little memory, which may be otherwise at another time.
  case outOfMemory

  package var description: String {
    switch self {
    case .invalidArgument(let message): "invalid argument: \(message)"
    case .degenerate(let message), .failed(let message): message
    case .outOfMemory: "out of memory"
    }
  }

  package var errorDescription: String? { description }
}

/// Calls a kernel and turns its status into an error.
///
/// The `ck_control` is valid during `body` only.
package func withKernel(
  _ control: KernelControl, _ body: (UnsafePointer<ck_control>) -> ck_status
) throws {
  ck_silence_libraries()
  let status = withExtendedLifetime(control) {
    var raw = ck_control(
      context: Unmanaged.passUnretained(control).toOpaque(),
      should_continue: { context, fraction in
        guard let context else { return true }
        return Unmanaged<KernelControl>.fromOpaque(context).takeUnretainedValue()
          .shouldContinue(at: fraction)
      },
      threads: Int32(control.threadCount))
    return withUnsafePointer(to: &raw) { body($0) }
  }
  switch status {
  case ck_ok: return
  case ck_cancelled: throw CancellationError()
  case ck_invalid_argument: throw KernelError.invalidArgument(String(cString: ck_last_error()))
  case ck_degenerate: throw KernelError.degenerate(String(cString: ck_last_error()))
  case ck_out_of_memory: throw KernelError.outOfMemory
  default: throw KernelError.failed(String(cString: ck_last_error()))
  }
}

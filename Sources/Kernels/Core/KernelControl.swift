import CKernels
import Synchronization
import SceneModel

/// Reports progress of kernels, and passes cancellation to them.
///
/// Kernels call back from threads that they create, where `Task.isCancelled` has no effect; hence
/// the flag.
package final class KernelControl: Sendable {
  /// Receives the fraction done, 0…1, on any thread.
  package typealias ProgressHandler = @Sendable (Double) -> Void

  /// Maximum number of threads of kernels, at least 1. Results do not depend on it.
  package let threadCount: Int
  private let flag: CancellationFlag
  private let onProgress: ProgressHandler?

  /// Controls that share `flag` are canceled together.
  package init(
    threadCount: Int = 1, flag: CancellationFlag = CancellationFlag(),
    onProgress: ProgressHandler? = nil
  ) {
    self.threadCount = max(1, threadCount)
    self.flag = flag
    self.onProgress = onProgress
  }

  /// Whether the run is canceled.
  package var isCancelled: Bool { flag.isCancelled }

  /// Reports progress; throws `CancellationError` if the run is canceled.
  package func step(_ fraction: Double) throws {
    onProgress?(fraction)
    try checkCancellation()
  }

  /// Throws `CancellationError` if the run is canceled.
  package func checkCancellation() throws {
    if isCancelled { throw CancellationError() }
  }

  /// A control for the part of the work that covers `start` to `end` of this control's progress.
  package func part(from start: Double, to end: Double) -> KernelControl {
    KernelControl(threadCount: threadCount, flag: flag) { [onProgress] fraction in
      onProgress?(start + (end - start) * fraction)
    }
  }

  /// A control for each of `count` concurrent units of work; their mean is reported as this
  /// control's progress.
  func units(_ count: Int) -> [KernelControl] {
    let progress = UnitProgress(count)
    return (0..<count).map { unit in
      KernelControl(threadCount: threadCount, flag: flag) { [onProgress] fraction in
        onProgress?(progress.report(fraction, of: unit))
      }
    }
  }

  /// A copy that reports no progress.
  package var withoutProgress: KernelControl { KernelControl(threadCount: threadCount, flag: flag) }

  /// Reports progress; returns false if the run is canceled.
  fileprivate func shouldContinue(at fraction: Double) -> Bool {
    onProgress?(fraction)
    return !isCancelled
  }
}

/// The progress of several concurrent units of work.
private final class UnitProgress: Sendable {
  private let fractions: Locked<(units: [Double], sum: Double)>

  init(_ count: Int) {
    fractions = Locked((units: [Double](repeating: 0, count: count), sum: 0))
  }

  /// Updates a unit's fraction, and returns the overall one.
  func report(_ fraction: Double, of unit: Int) -> Double {
    fractions.withLock { state in
      let step = max(0, min(1, fraction) - state.units[unit])
      state.units[unit] += step
      state.sum += step
      return state.sum / Double(state.units.count)
    }
  }
}

/// Calls a kernel and converts its status to an error.
///
/// Throws `CancellationError` if the control cancels the kernel, otherwise `KernelError`. The
/// `ck_control` is valid only during `body`.
package func withKernel(
  _ control: KernelControl, _ body: (UnsafePointer<ck_control>) -> ck_status
) throws {
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
  case ck_canceled: throw CancellationError()
  case ck_invalid_argument: throw KernelError.invalidArgument(String(cString: ck_last_error()))
  case ck_degenerate: throw KernelError.degenerate(String(cString: ck_last_error()))
  case ck_out_of_memory: throw KernelError.outOfMemory
  case ck_left_out: throw KernelError.leftOut(library: String(cString: ck_last_error()))
  default: throw KernelError.failed(String(cString: ck_last_error()))
  }
}

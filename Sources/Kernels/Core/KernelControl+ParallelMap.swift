import Foundation
import Synchronization
import SceneModel

extension KernelControl {
  /// Maps `0..<count` on the control's threads; results are in index order, independent of
  /// scheduling.
  ///
  /// Blocks the calling thread. Reports progress and checks for cancellation (`CancellationError`)
  /// between units. If units fail, throws the error of the lowest failed index.
  package func parallelMap<Result: Sendable>(
    _ count: Int, _ body: @escaping @Sendable (Int) throws -> Result
  ) throws -> [Result] {
    let threads = min(threadCount, count)
    guard threads > 1 else {
      return try (0..<count).map { index in
        try step(Double(index) / Double(count))
        return try body(index)
      }
    }
    let results = Locked<[Swift.Result<Result, any Error>?]>(Array(repeating: nil, count: count))
    let next = Atomic<Int>(0)
    let stop = Atomic<Bool>(false)
    DispatchQueue.concurrentPerform(iterations: threads) { _ in
      while !stop.load(ordering: .relaxed) {
        let index = next.add(1, ordering: .relaxed).oldValue
        guard index < count else { return }
        let result = Swift.Result {
          try self.step(Double(index) / Double(count))
          return try body(index)
        }
        if case .failure = result { stop.store(true, ordering: .relaxed) }
        results.withLock { $0[index] = result }
      }
    }
    return try results.withLock { slots in
      if let failure = slots.lazy.compactMap({ $0 }).first(where: { (try? $0.get()) == nil }) {
        _ = try failure.get()
      }
      return try slots.compactMap { try $0?.get() }
    }
  }

  /// Like `parallelMap`, but progress is the mean of what the units report to their controls; a
  /// unit that reports nothing counts when it ends.
  package func parallelUnits<Result: Sendable>(
    _ count: Int, _ body: @escaping @Sendable (Int, KernelControl) throws -> Result
  ) throws -> [Result] {
    let controls = units(count)
    return try withoutProgress.parallelMap(count) { index in
      let result = try body(index, controls[index])
      try controls[index].step(1)
      return result
    }
  }
}

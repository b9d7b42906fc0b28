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

  /// Maps 0..<count like `parallelMap`, in units of consecutive indices, so that short calls cost
  /// little; `body` returns the results of a unit.
  package func parallelMap<Result: Sendable>(
    _ count: Int, inUnitsOf size: Int, _ body: @escaping @Sendable (Range<Int>) throws -> [Result]
  ) throws -> [Result] {
    let units = try parallelMap(0..<count, perUnitOf: size, body)
    var results: [Result] = []
    results.reserveCapacity(count)
    for unit in units { results.append(contentsOf: unit) }
    return results
  }

  /// Maps units of `size` consecutive indices of a range like `parallelMap`, to one result each;
  /// the last unit may be smaller.
  package func parallelMap<Result: Sendable>(
    _ range: Range<Int>, perUnitOf size: Int,
    _ body: @escaping @Sendable (Range<Int>) throws -> Result
  ) throws -> [Result] {
    try parallelMap((range.count + size - 1) / size) { unit in
      let start = range.lowerBound + unit * size
      return try body(start..<min(start + size, range.upperBound))
    }
  }

  /// Maps the elements of an array like `parallelMap`, and empties it: `body` owns its element, and
  /// may change it in place; its memory is free when `body` returns.
  package func parallelMap<Element: Sendable, Result: Sendable>(
    draining elements: inout [Element],
    _ body: @escaping @Sendable (Int, inout Element) throws -> Result
  ) throws -> [Result] {
    let waiting = Locked<[Element?]>(elements)
    let count = elements.count
    elements = []
    return try parallelMap(count) { index in
      guard var element = waiting.withLock({ $0[index].take() }) else {
        preconditionFailure("an element is mapped once")
      }
      return try body(index, &element)
    }
  }

  /// Runs three independent calls on the control's threads.
  package func concurrently<First: Sendable, Second: Sendable, Third: Sendable>(
    _ first: @escaping @Sendable (KernelControl) throws -> First,
    _ second: @escaping @Sendable (KernelControl) throws -> Second,
    _ third: @escaping @Sendable (KernelControl) throws -> Third
  ) throws -> (First, Second, Third) {
    let results = Locked<(First?, Second?, Third?)>((nil, nil, nil))
    _ = try parallelUnits(3) { index, control in
      switch index {
      case 0:
        let value = try first(control)
        results.withLock { $0.0 = value }
      case 1:
        let value = try second(control)
        results.withLock { $0.1 = value }
      default:
        let value = try third(control)
        results.withLock { $0.2 = value }
      }
    }
    guard case (let first?, let second?, let third?) = results.withLock({ $0 }) else {
      preconditionFailure("all calls have returned")
    }
    return (first, second, third)
  }
}

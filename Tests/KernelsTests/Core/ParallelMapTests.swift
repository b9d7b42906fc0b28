import Kernels
import SceneModel
import Testing

@Suite struct ParallelMapTests {
  private struct Failure: Error, Equatable {
    var index: Int
  }

  @Test(arguments: [1, 2, 3, 8], [0, 1, 5, 64, 1000])
  func resultsAreInOrder(threads: Int, count: Int) throws {
    let control = KernelControl(threadCount: threads)
    let expected = (0..<count).map { $0 * $0 }
    #expect(try control.parallelMap(count) { $0 * $0 } == expected)
    for size in [1, 7, 2000] {
      #expect(try control.parallelMap(count, inUnitsOf: size) { $0.map { $0 * $0 } } == expected)
    }
  }

  @Test(arguments: [1, 3], [(5..<5, 4), (3..<11, 4), (3..<12, 4), (7..<9, 4), (2..<5, 1)])
  func unitsCoverTheRange(threads: Int, units: (range: Range<Int>, size: Int)) throws {
    let ranges = try KernelControl(threadCount: threads)
      .parallelMap(units.range, perUnitOf: units.size) { $0 }
    #expect(ranges.flatMap { Array($0) } == Array(units.range))
    #expect(ranges.dropLast().allSatisfy { $0.count == units.size })
    #expect(ranges.allSatisfy { !$0.isEmpty && $0.count <= units.size })
  }

  @Test(arguments: [1, 2, 3, 8]) func drainedElementsAreMappedOnce(threads: Int) throws {
    let control = KernelControl(threadCount: threads)
    var elements = (0..<100).map { [$0] }
    let sums = try control.parallelMap(draining: &elements) { index, element in
      element.append(index)
      return element.reduce(0, +)
    }
    #expect(sums == (0..<100).map { 2 * $0 })
    #expect(elements.isEmpty)
    var none: [Int] = []
    #expect(try control.parallelMap(draining: &none) { $0 + $1 }.isEmpty)
  }

  @Test(arguments: [1, 4]) func theLowestFailureIsThrown(threads: Int) {
    let control = KernelControl(threadCount: threads)
    #expect(throws: Failure(index: 3)) {
      try control.parallelMap(100, inUnitsOf: 10) {
        try $0.map { index in
          if index >= 3, index < 10 { throw Failure(index: index) }
          return index
        }
      }
    }
  }

  @Test(arguments: [1, 2, 3]) func threeCallsReturnTheirResults(threads: Int) throws {
    let control = KernelControl(threadCount: threads)
    let (number, text, list) = try control.concurrently(
      { _ in 7 }, { _ in "seven" }, { _ in [7.5] })
    #expect(number == 7 && text == "seven" && list == [7.5])
    for failing in 0..<3 {
      @Sendable func call(_ index: Int) throws -> Int {
        if index == failing { throw Failure(index: index) }
        return index
      }
      #expect(throws: Failure(index: failing)) {
        try control.concurrently({ _ in try call(0) }, { _ in try call(1) }, { _ in try call(2) })
      }
    }
  }

  /// A canceled run starts none of the calls.
  @Test func cancellationEndsConcurrentCalls() {
    let flag = CancellationFlag()
    flag.cancel()
    let control = KernelControl(threadCount: 2, flag: flag) { _ in }
    let calls = Locked(0)
    #expect(throws: CancellationError.self) {
      try control.concurrently(
        { _ in calls.withLock { $0 += 1 } }, { _ in calls.withLock { $0 += 1 } },
        { _ in calls.withLock { $0 += 1 } })
    }
    #expect(calls.withLock { $0 } == 0)
  }
}

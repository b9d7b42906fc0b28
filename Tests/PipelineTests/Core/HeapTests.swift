import TestSupport
import Testing

@testable import Pipeline

@Suite struct HeapTests {
  @Test(arguments: [0, 1, 2, 7, 100]) func elementsComeInOrder(count: Int) {
    var generator = SeededGenerator(seed: UInt64(count))
    let numbers = (0..<count).map { _ in Int(generator.uniform() * 50) }
    var heap = Heap<Int> { $0 < $1 }
    numbers.forEach { heap.insert($0) }
    var taken: [Int] = []
    while let first = heap.popFirst() { taken.append(first) }
    #expect(taken == numbers.sorted())
  }
}

import Pipeline
import TestSupport
import Testing

@Suite struct BlockTests {
  @Test(arguments: [0, 1, 7, 100])
  func blocksCoverEverythingOnce(total: Int) {
    for count in 1...9 {
      let indices = (0..<count).flatMap { Block(index: $0, of: count).range(of: total) }
      #expect(indices == Array(0..<total))
    }
  }

  @Test(arguments: [0, 1, 5, 40], [1, 3, 8])
  func blocksOfWeightsCoverAllElementsOnce(elements: Int, blocks: Int) {
    var random = SeededGenerator(seed: 1)
    for largest in [0, 1, 1000] {
      let weights = (0..<elements).map { _ in Int(Double(largest) * random.uniform()) }
      let indices = (0..<blocks).flatMap { Block(index: $0, of: blocks).range(ofWeights: weights) }
      #expect(indices == Array(0..<elements))
    }
  }

  /// A block has its share of the weight, but for parts of the elements at its ends.
  @Test func blocksHaveAboutTheSameWeight() {
    var random = SeededGenerator(seed: 2)
    let weights = (0..<200).map { _ in Int(1 + 1000 * random.uniform()) }
    let share = weights.reduce(0, +) / 9
    for index in 0..<9 {
      let own = weights[Block(index: index, of: 9).range(ofWeights: weights)].reduce(0, +)
      #expect(abs(own - share) <= 1001)
    }
  }
}

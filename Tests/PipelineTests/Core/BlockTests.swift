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
      let indices = (0..<blocks).flatMap {
        Block(index: $0, of: blocks).indices(ofWeights: weights)
      }
      #expect(indices.sorted() == Array(0..<elements))
    }
  }

  /// The greatest weight is at most that of an element above the least (Graham 1969).
  @Test func blocksHaveAboutTheSameWeightAndTheHeaviestIsFirst() {
    var random = SeededGenerator(seed: 2)
    let weights = (0..<200).map { _ in Int(1 + 1000 * random.uniform()) }
    let sums = (0..<9).map { index in
      Block(index: index, of: 9).indices(ofWeights: weights).reduce(0) { $0 + weights[$1] }
    }
    #expect(sums == sums.sorted(by: >))
    #expect(sums[0] - sums[8] <= weights.max() ?? 0)
  }

  @Test func blocksAreElementsInDescendingOrderIfThereAreEnough() {
    let blocks = (0..<4).map { Block(index: $0, of: 4).indices(ofWeights: [3, 9, 5]) }
    #expect(blocks == [[1], [2], [0], []])
  }
}

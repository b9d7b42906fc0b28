import SceneModel
import Testing

@testable import Pipeline

@Suite struct OrderStatisticsTests {
  /// Bytes are counted, other elements sorted.
  @Test(arguments: [1, 2, 7, 1000]) func bytesHaveTheQuantilesOfNumbers(_ count: Int) {
    var random = SplitMix64(seed: UInt64(count))
    let bytes = (0..<count).map { _ in UInt8.random(in: 0...255, using: &random) }
    for q in [0, 0.1, 0.5, 0.75, 0.999, 1] {
      #expect(bytes.quantile(q).map(Int.init) == bytes.map(Int.init).quantile(q))
    }
  }

  /// With few and many values that are equal, in random, ascending and descending order.
  @Test(arguments: [1, 2, 16, 17, 1000], [3, 1_000_000])
  func elementsAreSelectedAsIfSorted(_ count: Int, _ distinct: Int) {
    var random = SplitMix64(seed: UInt64(count))
    let values = (0..<count).map { _ in Int.random(in: 0..<distinct, using: &random) }
    let sorted = values.sorted()
    for order in [values, sorted, sorted.reversed()] {
      for rank in Set([0, count / 3, count / 2, count - 1]) {
        #expect(order.element(ofRank: rank) == sorted[rank])
      }
    }
  }

  @Test func nothingHasNoQuantile() {
    #expect([UInt8]().quantile(0.5) == nil)
    #expect([Double]().quantile(0.5) == nil)
  }
}

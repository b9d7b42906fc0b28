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

  @Test func nothingHasNoQuantile() {
    #expect([UInt8]().quantile(0.5) == nil)
    #expect([Double]().quantile(0.5) == nil)
  }
}

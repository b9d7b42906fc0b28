import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ColorHistogramTests {
  private func pixel(_ color: SIMD3<Int>) -> RasterImage {
    RasterImage(
      width: 1, height: 1, channels: 3,
      pixels: [UInt8(color.x), UInt8(color.y), UInt8(color.z)])
  }

  @Test func binsHaveTheirColors() {
    let bins = (0..<ColorHistogram.count).map { bin in
      ColorHistogram.bin(pixel(ColorHistogram.color(ofBin: bin)), 0)
    }
    #expect(bins == Array(0..<ColorHistogram.count))
    for color: SIMD3<Int> in [[0, 0, 0], [255, 255, 255], [7, 8, 200], [131, 64, 63]] {
      let center = ColorHistogram.color(ofBin: ColorHistogram.bin(pixel(color), 0))
      #expect((0..<3).allSatisfy { abs(center[$0] - color[$0]) <= 4 })
    }
  }

  @Test func probabilitiesSumToOne() {
    var histogram = ColorHistogram()
    histogram.add(TexturePattern.image(width: 60, height: 40, seed: 3)) { _ in true }
    #expect(histogram.total == 2400)
    for share: Float in [0, 0.02, 0.5] {
      let probabilities = histogram.probabilities(unseenShare: share)
      let sum = probabilities.reduce(0.0) { $0 + Double($1) }
      #expect(abs(sum - 1) < 1e-3)
      #expect(probabilities.allSatisfy { $0 >= 0 })
    }
  }

  @Test func unseenColorsHaveTheEvenShare() {
    let even = 0.02 / Float(ColorHistogram.count)
    let none = ColorHistogram().probabilities(unseenShare: 0.02)
    #expect(none.allSatisfy { abs($0 - even) < 1e-3 * even })
    var histogram = ColorHistogram()
    let image = pixel([100, 100, 100])
    histogram.add(image) { _ in true }
    let probabilities = histogram.probabilities(unseenShare: 0.02)
    for color: SIMD3<Int> in [[0, 0, 0], [255, 255, 255], [100, 100, 200]] {
      let share = probabilities[ColorHistogram.bin(pixel(color), 0)]
      #expect(abs(share - even) < 1e-3 * even)
    }
    let seen = ColorHistogram.bin(image, 0)
    #expect(probabilities[seen] == probabilities.max())
    // The filter distributes it to the neighbors.
    #expect(abs(probabilities[seen] - 0.98 * 27 / 512) < 1e-3)
  }

  @Test func onlySelectedPixelsCount() {
    var image = RasterImage(width: 4, height: 1, channels: 3, filledWith: 20)
    image.pixels.replaceSubrange(6..<9, with: [200, 100, 50])
    var histogram = ColorHistogram()
    histogram.add(image) { $0 == 2 }
    #expect(histogram.total == 1 && histogram.weights[ColorHistogram.bin(image, 6)] == 1)
  }

  @Test func histogramsAreAddedWithWeights() {
    var (first, second) = (ColorHistogram(), ColorHistogram())
    first.add(pixel([0, 0, 0])) { _ in true }
    second.add(RasterImage(width: 8, height: 1, channels: 3, filledWith: 90)) { _ in true }
    first.add(second, total: 3)
    #expect(abs(first.total - 4) < 1e-5)
    first.add(ColorHistogram(), total: 5)
    #expect(abs(first.total - 4) < 1e-5)
  }
}

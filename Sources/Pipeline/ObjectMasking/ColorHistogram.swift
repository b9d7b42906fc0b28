import SceneModel

/// A distribution of colors: a histogram of RGB values with 32 levels per channel, smoothed by a
/// binomial filter.
struct ColorHistogram: Sendable {
  /// Levels of each channel. Chosen.
  static let levels = 32
  /// Number of bins.
  static let count = levels * levels * levels

  private(set) var weights = [Float](repeating: 0, count: Self.count)

  /// The bin of the pixel that starts at `offset` in the image's bytes.
  static func bin(_ image: RasterImage, _ offset: Int) -> Int {
    let (r, g, b) = (image.pixels[offset], image.pixels[offset + 1], image.pixels[offset + 2])
    return (Int(r >> 3) * levels + Int(g >> 3)) * levels + Int(b >> 3)
  }

  /// The RGB value at the center of a bin.
  static func color(ofBin bin: Int) -> SIMD3<Int> {
    8 &* SIMD3(bin / (levels * levels), bin / levels % levels, bin % levels) &+ 4
  }

  /// Adds the pixels of an RGB image that `isIncluded` selects by index.
  mutating func add(_ image: RasterImage, where isIncluded: (Int) -> Bool) {
    for pixel in 0..<image.width * image.height where isIncluded(pixel) {
      weights[Self.bin(image, 3 * pixel)] += 1
    }
  }

  /// Adds another histogram, scaled so that its total is `total`.
  mutating func add(_ other: ColorHistogram, total: Float) {
    let sum = other.weights.reduce(0, +)
    guard sum > 0 else { return }
    for index in weights.indices { weights[index] += other.weights[index] * total / sum }
  }

  /// The number of pixels.
  var total: Float { weights.reduce(0, +) }

  /// The probability of every bin: smoothed, with a small share distributed evenly over all bins,
  /// since a color that was never seen is not impossible.
  func probabilities(unseenShare: Float = 0.02) -> [Float] {
    var smoothed = weights
    for axis in 0..<3 { smoothed = Self.smoothed(smoothed, along: axis) }
    let sum = max(smoothed.reduce(0, +), .leastNormalMagnitude)
    return smoothed.map { (1 - unseenShare) * $0 / sum + unseenShare / Float(Self.count) }
  }

  /// The convolution with (1, 4, 6, 4, 1) / 16 along one axis; border bins extend outward.
  private static func smoothed(_ source: [Float], along axis: Int) -> [Float] {
    let stride = [levels * levels, levels, 1][axis]
    var result = source
    for start in 0..<count where start / stride % levels == 0 {
      for level in 0..<levels {
        func value(_ offset: Int) -> Float {
          source[start + stride * min(levels - 1, max(0, level + offset))]
        }
        result[start + stride * level] =
          (value(-2) + 4 * value(-1) + 6 * value(0) + 4 * value(1) + value(2)) / 16
      }
    }
    return result
  }
}

import Kernels
import SceneModel

/// A texture with successively halved levels, down to one texel (Williams, "Pyramidal Parametrics",
/// SIGGRAPH 1983).
struct MipMap: Sendable {
  private struct Level {
    var width: Int
    var height: Int
    /// Of its first byte in `coarser`.
    var offset: Int
  }

  private let levels: [Level]
  private let base: [UInt8]
  /// All levels except the full-size one, concatenated.
  private let coarser: [UInt8]
  /// Texels of the full-size level.
  let texelCount: Float

  /// Accepts RGB or gray.
  init(_ image: RasterImage) throws {
    var image = image.channels == 3 ? image : Self.rgb(image)
    base = image.pixels
    texelCount = Float(image.width) * Float(image.height)
    var levels = [Level(width: image.width, height: image.height, offset: 0)]
    var coarser: [UInt8] = []
    coarser.reserveCapacity(image.pixels.count / 3 + 64)
    while image.width > 1 || image.height > 1 {
      image = try image.resized(width: max(1, image.width / 2), height: max(1, image.height / 2))
      levels.append(Level(width: image.width, height: image.height, offset: coarser.count))
      coarser += image.pixels
    }
    (self.levels, self.coarser) = (levels, coarser)
  }

  private static func rgb(_ image: RasterImage) -> RasterImage {
    let channels = image.channels
    let pixels = stride(from: 0, to: image.pixels.count, by: channels).flatMap { start in
      (0..<3).map { image.pixels[start + (channels > 3 ? $0 : 0)] }
    }
    return RasterImage(width: image.width, height: image.height, channels: 3, pixels: pixels)
  }

  /// The color, 0…255, at a texture coordinate: trilinear, within a level and between two. A texel
  /// of level n is 2ⁿ full-size texels wide.
  func color(_ coordinate: SIMD2<Float>, level: Float) -> SIMD3<Float> {
    let bounded = min(max(level, 0), Float(levels.count - 1))
    let fine = Int(bounded)
    let share = bounded - Float(fine)
    let color = bilinear(coordinate, fine)
    guard share > 0 else { return color }
    return color + (bilinear(coordinate, fine + 1) - color) * share
  }

  private func bilinear(_ coordinate: SIMD2<Float>, _ number: Int) -> SIMD3<Float> {
    let level = levels[number]
    let x = min(max(coordinate.x * Float(level.width) - 0.5, 0), Float(level.width - 1))
    let y = min(max((1 - coordinate.y) * Float(level.height) - 0.5, 0), Float(level.height - 1))
    let (left, top) = (Int(x), Int(y))
    let right = min(left + 1, level.width - 1)
    let bottom = min(top + 1, level.height - 1)
    let (s, t) = (x - Float(left), y - Float(top))
    let upper = level.offset + top * level.width * 3
    let lower = level.offset + bottom * level.width * 3
    let above = texel(number, upper + 3 * left) * (1 - s) + texel(number, upper + 3 * right) * s
    let below = texel(number, lower + 3 * left) * (1 - s) + texel(number, lower + 3 * right) * s
    return above * (1 - t) + below * t
  }

  private func texel(_ level: Int, _ start: Int) -> SIMD3<Float> {
    level == 0
      ? SIMD3(Float(base[start]), Float(base[start + 1]), Float(base[start + 2]))
      : SIMD3(Float(coarser[start]), Float(coarser[start + 1]), Float(coarser[start + 2]))
  }
}

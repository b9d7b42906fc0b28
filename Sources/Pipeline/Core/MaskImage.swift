import ImageFiles
import Kernels
import SceneModel

/// Decodes masks: gray images, as stored, with 255 on the object and 0 elsewhere.
enum MaskImage {
  /// The mask in a separate file: black or transparent pixels are not part of the object.
  ///
  /// JPEG blurs the edge between black and white and leaves artifacts in black areas, so pixels
  /// darker than half count as black.
  static func decode(_ bytes: [UInt8]) throws(ImageError) -> RasterImage {
    let colors = try ImageCodec.decode(bytes)
    let least: UInt8 = try ImageHeader(bytes).format == .jpeg ? 128 : 1
    var mask = RasterImage(width: colors.width, height: colors.height, channels: 1)
    for index in mask.pixels.indices {
      let brightest = max(
        colors.pixels[3 * index], colors.pixels[3 * index + 1], colors.pixels[3 * index + 2])
      if brightest >= least { mask.pixels[index] = 255 }
    }
    if let alpha = try ImageCodec.decodeAlpha(bytes), alpha.pixels.count == mask.pixels.count {
      for index in mask.pixels.indices where alpha.pixels[index] == 0 { mask.pixels[index] = 0 }
    }
    return mask
  }

  /// The mask in a photo's alpha channel: pixels that are less than half opaque are not part of the
  /// object, since programs that cut out objects leave traces around them. Nil without an alpha
  /// channel.
  static func alpha(_ bytes: [UInt8]) throws(ImageError) -> RasterImage? {
    guard var mask = try ImageCodec.decodeAlpha(bytes) else { return nil }
    for index in mask.pixels.indices { mask.pixels[index] = mask.pixels[index] < 128 ? 0 : 255 }
    return mask
  }
}

extension RasterImage {
  /// The least value of a mask's pixels that are marked. Chosen: half of the largest.
  static let leastMarked: UInt8 = 128

  /// Whether the mask marks a position, in pixels, as object; false outside the mask.
  func isMarked(at pixel: SIMD2<Double>) -> Bool {
    guard pixel.x >= 0, pixel.y >= 0, pixel.x < Double(width), pixel.y < Double(height) else {
      return false
    }
    return pixels[Int(pixel.y) * width + Int(pixel.x)] >= Self.leastMarked
  }
}

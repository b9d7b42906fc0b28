import SceneModel

/// Writes Windows bitmaps.
package enum BMPWriter {
  /// The content of a file with 24 or 32 bits per pixel, or with 8 bits: the red channel as index
  /// into a palette. `compression` is only declared.
  package static func file(
    _ image: RasterImage, bits: Int = 24, isTopDown: Bool = false, compression: Int = 0
  ) -> [UInt8] {
    let rows = (0..<image.height).map { row($0, of: image, bits) }
    let pixels = Array((isTopDown ? rows : rows.reversed()).joined())
    let colors = bits == 8 ? palette : []
    let offset = 54 + colors.count
    let height = isTopDown ? -image.height : image.height
    let file = [offset + pixels.count, 0, offset, 40, image.width, height]
    let coding = [compression, pixels.count, 2835, 2835, 0, 0]
    var bytes = Array("BM".utf8)
    for number in file { bytes += littleEndian(number) }
    bytes += littleEndian(1, 2) + littleEndian(bits, 2)
    for number in coding { bytes += littleEndian(number) }
    return bytes + colors + pixels
  }

  /// The color (red, green, blue) of an index.
  package static func color(_ index: UInt8) -> [UInt8] { [index / 2, 255 - index, index] }

  /// Blue, green, red and an unused byte for each index.
  private static var palette: [UInt8] {
    (0...255).flatMap { color($0).reversed() + [0] }
  }

  /// A row, padded to four bytes.
  private static func row(_ y: Int, of image: RasterImage, _ bits: Int) -> [UInt8] {
    var bytes: [UInt8] = []
    for x in 0..<image.width {
      let rgb = image.pixels[(y * image.width + x) * 3..<(y * image.width + x) * 3 + 3]
      switch bits {
      case 8: bytes += rgb.prefix(1)
      case 24: bytes += rgb.reversed()
      default: bytes += rgb.reversed() + [255]
      }
    }
    return bytes + [UInt8](repeating: 0, count: (4 - bytes.count % 4) % 4)
  }
}

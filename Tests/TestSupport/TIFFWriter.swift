import SceneModel

/// Writes little-endian TIFF files with one uncompressed strip.
package enum TIFFWriter {
  private enum FieldType: Int { case short = 3, long = 4 }

  private struct Field {
    var tag: Int
    var type: FieldType
    var count = 1
    /// The value of a single number, the offset of several.
    var value: Int
  }

  /// An image of red, green, blue and opacity, 8 bits each.
  package static func rgba(_ image: RasterImage, orientation: Int = 1) -> [UInt8] {
    let bits = [8, 8, 8, 8].flatMap { littleEndian($0, 2) }
    return file(
      before: bits, strip: image.pixels,
      [
        Field(tag: 256, type: .short, value: image.width),
        Field(tag: 257, type: .short, value: image.height),
        Field(tag: 258, type: .short, count: 4, value: 8),
        Field(tag: 259, type: .short, value: 1), Field(tag: 262, type: .short, value: 2),
        Field(tag: 273, type: .long, value: 8 + bits.count),
        Field(tag: 274, type: .short, value: orientation),
        Field(tag: 277, type: .short, value: 4), Field(tag: 278, type: .short, value: image.height),
        Field(tag: 279, type: .long, value: image.pixels.count),
        Field(tag: 338, type: .short, value: 2),
      ])
  }

  /// One channel of 32-bit floating-point numbers.
  package static func numbers(width: Int, height: Int, _ values: [Float]) -> [UInt8] {
    file(
      strip: values.flatMap { littleEndian(Int($0.bitPattern)) },
      [
        Field(tag: 256, type: .short, value: width), Field(tag: 257, type: .short, value: height),
        Field(tag: 258, type: .short, value: 32), Field(tag: 259, type: .short, value: 1),
        Field(tag: 262, type: .short, value: 1), Field(tag: 273, type: .long, value: 8),
        Field(tag: 277, type: .short, value: 1), Field(tag: 278, type: .short, value: height),
        Field(tag: 279, type: .long, value: 4 * values.count),
        Field(tag: 339, type: .short, value: 3),
      ])
  }

  /// The header, a table of values if there is one, the pixels and the directory.
  private static func file(
    before table: [UInt8] = [], strip: [UInt8], _ fields: [Field]
  ) -> [UInt8] {
    let entries = fields.flatMap { field -> [UInt8] in
      littleEndian(field.tag, 2) + littleEndian(field.type.rawValue, 2)
        + littleEndian(field.count) + littleEndian(field.value)
    }
    let header =
      Array("II".utf8) + littleEndian(42, 2) + littleEndian(8 + table.count + strip.count)
    let directory = littleEndian(fields.count, 2) + entries + littleEndian(0)
    return header + table + strip + directory
  }
}

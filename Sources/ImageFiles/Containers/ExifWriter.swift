/// Writes EXIF data (a TIFF structure) and inserts it into JPEG files.
package enum ExifWriter {
  private struct Field {
    var tag: UInt16
    var type: UInt16
    var count: UInt32
    var data: [UInt8]
  }

  /// The JPEG file with the fields in an APP1 segment after its first marker.
  package static func jpeg(_ jpeg: [UInt8], with fields: ExifFields) -> [UInt8] {
    let content = Array("Exif\0\0".utf8) + tiff(fields)
    let segment = [0xFF, 0xE1] + bigEndian(UInt16(content.count + 2)) + content
    return Array(jpeg.prefix(2)) + segment + Array(jpeg.dropFirst(2))
  }

  /// A big-endian TIFF structure with the image, EXIF and GPS directories.
  package static func tiff(_ fields: ExifFields) -> [UInt8] {
    var image: [Field] = []
    if let make = fields.make { image.append(text(271, make)) }
    if let model = fields.model { image.append(text(272, model)) }
    if let orientation = fields.orientation { image.append(short(274, orientation)) }
    var exif: [Field] = []
    if let value = fields.focalLength { exif.append(rationals(37386, [value])) }
    if let size = fields.originalSize {
      exif += [long(40962, size.width), long(40963, size.height)]
    }
    if let value = fields.focalPlaneResolution {
      exif += [rationals(41486, [value]), short(41488, 2)]
    }
    if let value = fields.focalLengthIn35mmFilm { exif.append(short(41989, value)) }
    let gps = gpsFields(fields)

    // Pointers have a fixed size, so the offsets of the directories follow from the preceding
    // sizes.
    let header = bigEndian(UInt16(0x4D4D)) + bigEndian(UInt16(42)) + bigEndian(UInt32(8))
    let imageSize = size(of: image) + 24
    let exifOffset = 8 + imageSize
    image.append(long(34665, exifOffset))
    image.append(long(34853, exifOffset + size(of: exif)))
    return header + directory(image, at: 8) + directory(exif, at: exifOffset)
      + directory(gps, at: exifOffset + size(of: exif))
  }

  private static func gpsFields(_ fields: ExifFields) -> [Field] {
    guard let position = fields.position else { return [] }
    func angle(_ tag: UInt16, _ degrees: Double) -> Field {
      let seconds = UInt32((abs(degrees) * 3600 * 1000).rounded())
      return rationals(
        tag,
        [
          (seconds / 3_600_000, 1), (seconds / 60000 % 60, 1), (seconds % 60000, 1000),
        ])
    }
    return [
      text(1, position.latitude < 0 ? "S" : "N"), angle(2, position.latitude),
      text(3, position.longitude < 0 ? "W" : "E"), angle(4, position.longitude),
      Field(tag: 5, type: 1, count: 1, data: [position.altitude < 0 ? 1 : 0]),
      rationals(6, [(UInt32((abs(position.altitude) * 100).rounded()), 100)]),
    ]
  }

  private static func size(of fields: [Field]) -> Int {
    2 + 12 * fields.count + 4 + fields.reduce(0) { $0 + ($1.data.count > 4 ? $1.data.count : 0) }
  }

  private static func directory(_ fields: [Field], at offset: Int) -> [UInt8] {
    var entries = bigEndian(UInt16(fields.count))
    var values: [UInt8] = []
    let valuesStart = offset + 2 + 12 * fields.count + 4
    for field in fields.sorted(by: { $0.tag < $1.tag }) {
      entries += bigEndian(field.tag) + bigEndian(field.type) + bigEndian(field.count)
      if field.data.count > 4 {
        entries += bigEndian(UInt32(valuesStart + values.count))
        values += field.data
      } else {
        entries += field.data + [UInt8](repeating: 0, count: 4 - field.data.count)
      }
    }
    return entries + [0, 0, 0, 0] + values
  }

  private static func text(_ tag: UInt16, _ text: String) -> Field {
    var data = Array(text.utf8) + [0]
    if data.count > 4, data.count % 2 == 1 { data.append(0) }
    return Field(tag: tag, type: 2, count: UInt32(data.count), data: data)
  }

  private static func short(_ tag: UInt16, _ value: Int) -> Field {
    Field(tag: tag, type: 3, count: 1, data: bigEndian(UInt16(truncatingIfNeeded: value)))
  }

  private static func long(_ tag: UInt16, _ value: Int) -> Field {
    Field(tag: tag, type: 4, count: 1, data: bigEndian(UInt32(truncatingIfNeeded: value)))
  }

  private static func rationals(_ tag: UInt16, _ values: [(UInt32, UInt32)]) -> Field {
    Field(
      tag: tag, type: 5, count: UInt32(values.count),
      data: values.flatMap { bigEndian($0.0) + bigEndian($0.1) })
  }

  private static func bigEndian<T: FixedWidthInteger>(_ value: T) -> [UInt8] {
    stride(from: T.bitWidth - 8, through: 0, by: -8).map { UInt8(truncatingIfNeeded: value >> $0) }
  }
}

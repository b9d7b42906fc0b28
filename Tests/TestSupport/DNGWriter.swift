import Foundation
import SceneModel

/// Writes little-endian DNG files with an uncompressed color filter array, like those of a camera
/// whose sensor has the primaries of sRGB.
package struct DNGWriter: Sendable {
  /// Size in pixels, even.
  package var width: Int
  package var height: Int
  /// As in EXIF, 1…8.
  package var orientation = 1
  /// Sensor values of darkness and saturation.
  package var black = 512
  package var white = 15360
  /// How strongly the sensor responds to neutral light, per channel.
  package var neutral = SIMD3(0.5, 1, 0.625)
  /// Millimeters.
  package var focalLength = 35
  /// Degrees south and east.
  package var place: (south: Int, east: Int)?

  package init(width: Int, height: Int) {
    self.width = width
    self.height = height
  }

  private enum FieldType: Int {
    case byte = 1
    case text = 2
    case short = 3
    case long = 4
    case rational = 5
    case signedRational = 10

    var size: Int { [1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 10: 8][rawValue] ?? 1 }
  }

  private struct Field {
    var tag: Int
    var type: FieldType
    var data: [UInt8]
    var count: Int { data.count / type.size }

    init(_ tag: Int, _ type: FieldType, _ values: [Int]) {
      (self.tag, self.type) = (tag, type)
      data = values.flatMap { littleEndian($0, type.size == 8 ? 4 : type.size) }
    }

    init(_ tag: Int, _ text: String) {
      (self.tag, type, data) = (tag, .text, Array(text.utf8) + [0])
    }

    init(_ tag: Int, _ type: FieldType, fractions: [Double]) {
      self.init(tag, type, fractions.flatMap { [Int(($0 * 10000).rounded()), 10000] })
    }
  }

  /// A photo whose linear colors, 0…1, are those of `color` at a column and a row.
  package func file(_ color: (Int, Int) -> SIMD3<Double>) -> [UInt8] {
    var mosaic: [UInt8] = []
    mosaic.reserveCapacity(2 * width * height)
    for row in 0..<height {
      for column in 0..<width {
        // Red and green, then green and blue.
        let channel = row % 2 + column % 2
        let light = color(column, row)[channel] * neutral[channel]
        let value = Double(black) + light * Double(white - black)
        mosaic += littleEndian(min(max(Int(value.rounded()), 0), 65535), 2)
      }
    }
    return file(mosaic: mosaic)
  }

  private func file(mosaic: [UInt8]) -> [UInt8] {
    let main = 8
    // The size of the directory doesn't depend on the offsets in it.
    let exif = main + directory(fields(exif: 0, gps: 0, pixels: 0), at: main).count
    let gps = exif + directory(exifFields, at: exif).count
    let pixels = gps + directory(gpsFields, at: gps).count
    return Array("II".utf8) + littleEndian(42, 2) + littleEndian(main)
      + directory(fields(exif: exif, gps: gps, pixels: pixels), at: main)
      + directory(exifFields, at: exif) + directory(gpsFields, at: gps) + mosaic
  }

  private func fields(exif: Int, gps: Int, pixels: Int) -> [Field] {
    // Linear sRGB from XYZ (IEC 61966-2-1).
    let matrix = [3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570]
    let camera = matrix.indices.map { matrix[$0] * neutral[$0 / 3] }
    return [
      Field(254, .long, [0]), Field(256, .long, [width]), Field(257, .long, [height]),
      Field(258, .short, [16]), Field(259, .short, [1]), Field(262, .short, [32803]),
      Field(271, "Maker"), Field(272, "Model 7"), Field(273, .long, [pixels]),
      Field(274, .short, [orientation]), Field(277, .short, [1]), Field(278, .long, [height]),
      Field(279, .long, [2 * width * height]), Field(284, .short, [1]),
      Field(33421, .short, [2, 2]), Field(33422, .byte, [0, 1, 1, 2]),
      Field(34665, .long, [exif]), Field(34853, .long, [gps]),
      Field(50706, .byte, [1, 4, 0, 0]), Field(50708, "Maker Model 7"),
      Field(50714, .long, [black]), Field(50717, .long, [white]),
      Field(50721, .signedRational, fractions: camera),
      Field(50728, .rational, fractions: [neutral.x, neutral.y, neutral.z]),
      Field(50778, .short, [21]),
    ]
  }

  private var exifFields: [Field] {
    [
      Field(36867, "2024:05:17 12:34:56"), Field(37386, .rational, [focalLength, 1]),
      Field(41989, .short, [focalLength * 3 / 2]),
    ]
  }

  private var gpsFields: [Field] {
    guard let place else { return [] }
    return [
      Field(1, "S"), Field(2, .rational, [place.south, 1, 0, 1, 0, 1]),
      Field(3, "E"), Field(4, .rational, [place.east, 1, 0, 1, 0, 1]),
    ]
  }

  private func directory(_ fields: [Field], at offset: Int) -> [UInt8] {
    var entries = littleEndian(fields.count, 2)
    var values: [UInt8] = []
    let start = offset + 2 + 12 * fields.count + 4
    for field in fields {
      entries += littleEndian(field.tag, 2) + littleEndian(field.type.rawValue, 2)
      entries += littleEndian(field.count)
      if field.data.count <= 4 {
        entries += field.data + [UInt8](repeating: 0, count: 4 - field.data.count)
      } else {
        entries += littleEndian(start + values.count)
        values += field.data + [UInt8](repeating: 0, count: field.data.count % 2)
      }
    }
    return entries + littleEndian(0) + values
  }
}

/// Writes EXIF data as iPhones do: with a maker note that has the reading of the accelerometer.
package enum AppleExifWriter {
  /// A big-endian TIFF structure. `acceleration` is in units of gravity, in the frame of Core
  /// Motion.
  package static func tiff(
    orientation: Int, acceleration: SIMD3<Double>, lens: String = "iPhone back camera"
  ) -> [UInt8] {
    let note = makerNote(acceleration)
    let lensText = Array(lens.utf8) + [0]
    let image: Int = 8
    let exif = image + 2 + 2 * 12 + 4
    let values = exif + 2 + 2 * 12 + 4
    return Array("MM".utf8) + bigEndian(42, 2) + bigEndian(image)
      + bigEndian(2, 2) + field(274, 3, 1, bigEndian(orientation, 2) + [0, 0])
      + field(34665, 4, 1, bigEndian(exif)) + bigEndian(0)
      + bigEndian(2, 2) + field(37500, 7, note.count, bigEndian(values))
      + field(42036, 2, lensText.count, bigEndian(values + note.count)) + bigEndian(0)
      + note + lensText
  }

  /// Offsets count from the start of the note.
  private static func makerNote(_ acceleration: SIMD3<Double>) -> [UInt8] {
    let denominator = 100_000
    let numbers = [acceleration.x, acceleration.y, acceleration.z].flatMap {
      bigEndian(Int(($0 * Double(denominator)).rounded())) + bigEndian(denominator)
    }
    let header = Array("Apple iOS\0".utf8) + [0, 1] + Array("MM".utf8)
    let end = header.count + 2 + 2 * 12 + 4
    return header + bigEndian(2, 2) + field(1, 9, 1, bigEndian(14))
      + field(8, 10, 3, bigEndian(end)) + bigEndian(0) + numbers
  }

  private static func field(_ tag: Int, _ type: Int, _ count: Int, _ value: [UInt8]) -> [UInt8] {
    bigEndian(tag, 2) + bigEndian(type, 2) + bigEndian(count) + value
  }
}

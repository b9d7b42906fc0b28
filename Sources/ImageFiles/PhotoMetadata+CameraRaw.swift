import CKernels
import SceneModel

extension PhotoMetadata {
  /// Adds what LibRaw knows, and EXIF data don't say or the file doesn't have as such.
  mutating func complete(with info: ck_raw_info) {
    sensorOrientation = Int(info.orientation)
    make = make ?? Self.text(info.make)
    model = model ?? Self.text(info.model)
    lens = lens ?? Self.text(info.lens)
    bodySerialNumber = bodySerialNumber ?? Self.text(info.body_serial_number)
    lensSerialNumber = lensSerialNumber ?? Self.text(info.lens_serial_number)
    captureTime = captureTime ?? Self.text(info.capture_time)
    if focalLength == nil, Self.focalLengths.contains(info.focal_length) {
      focalLength = info.focal_length
    }
    if focalLengthIn35mmFilm == nil,
      Self.focalLengthsIn35mmFilm.contains(info.focal_length_in_35mm_film)
    {
      focalLengthIn35mmFilm = info.focal_length_in_35mm_film
    }
    let isOnEarth = abs(info.latitude) <= 90 && abs(info.longitude) <= 180
    if position == nil, info.has_position, isOnEarth, info.latitude != 0 || info.longitude != 0 {
      position = GeographicPosition(
        latitudeDegrees: info.latitude, longitudeDegrees: info.longitude, altitude: info.altitude)
    }
  }

  /// The printable text in an array of characters that ends in zero; nil if it is empty.
  private static func text<Characters>(_ characters: Characters) -> String? {
    withUnsafeBytes(of: characters) { bytes in
      let printable = bytes.prefix { $0 != 0 }
        .map { (0x20..<0x7F).contains($0) ? $0 : UInt8(ascii: "?") }
      return printable.isEmpty ? nil : String(decoding: printable, as: UTF8.self)
    }
  }
}

import Kernels
import SceneModel

/// The camera metadata of a photo that reconstruction uses.
///
/// Read from the EXIF data of JPEG, PNG, WebP, HEIF and TIFF files (CIPA DC-008), and of camera raw
/// files. Missing, damaged or implausible values are nil.
package struct PhotoMetadata: Hashable, Codable, Sendable {
  /// EXIF orientation 1…8 that rotates the decoded pixels upright.
  package var orientation = 1
  /// EXIF orientation 1…8 that rotates the pixels of the sensor upright, even if the decoder has
  /// already applied it.
  package var sensorOrientation = 1
  /// Manufacturer of the camera.
  package var make: String?
  /// Model of the camera.
  package var model: String?
  /// Model of the lens.
  package var lens: String?
  /// Serial numbers of body and lens.
  package var bodySerialNumber: String?
  package var lensSerialNumber: String?
  /// Focal length in millimeters.
  package var focalLength: Double?
  /// 35 mm equivalent focal length in millimeters, rounded by the camera.
  package var focalLengthIn35mmFilm: Double?
  /// Pixels per millimeter on the sensor, for the photo as the camera wrote it.
  package var focalPlaneResolution: Double?
  /// Size in pixels of the photo as the camera wrote it; programs that resize photos often keep it.
  package var originalWidth: Int?
  package var originalHeight: Int?
  /// GPS position of the camera.
  package var position: GeographicPosition?
  /// As stored: "2024:05:17 12:34:56".
  package var captureTime: String?
  /// What the accelerometer of an iPhone measured while its back camera took the photo, in units of
  /// the gravity of Earth, in the frame of Core Motion: x right and y up on the screen, z toward
  /// the user. At rest this is the direction of gravity: (0, −1, 0) for a phone held upright.
  ///
  /// ExifTool describes the axes as reversed, because it takes the values for accelerations in the
  /// sense of physics. Photos with an orientation agree with Core Motion: those of an upright phone
  /// (6) have y ≈ −1, those of a phone on its left edge (1) have x ≈ −1.
  package var acceleration: SIMD3<Double>?

  /// Plausible values. Chosen.
  static let focalLengths = 0.5...5000
  static let focalLengthsIn35mmFilm = 2.0...5000

  package init() {}

  /// Reads the metadata from the content of a file.
  package init(_ bytes: [UInt8]) {
    let reader = ByteReader(bytes)
    if let tiff = TIFFStructure(exifOf: reader) { read(tiff) }
    if CameraRawFile.isRaw(reader) {
      if let info = try? CameraRawFile.inspect(bytes) { complete(with: info) }
    } else if TIFFStructure(reader) == nil, HEIFFile.Kind(reader) == nil {
      // The decoders of the other formats apply the orientation themselves.
      orientation = sensorOrientation
    }
  }

  /// Reads all but the orientation of the decoded pixels.
  private mutating func read(_ tiff: TIFFStructure) {
    let image = Fields(tiff, tiff.firstDirectory)
    let exif = Fields(tiff, image.integer(TIFFTag.exifDirectory) ?? 0)
    sensorOrientation =
      image.integer(TIFFTag.orientation).flatMap { (1...8).contains($0) ? $0 : nil } ?? 1
    make = image.text(TIFFTag.make)
    model = image.text(TIFFTag.model)
    lens = exif.text(TIFFTag.lensModel)
    bodySerialNumber = exif.text(TIFFTag.bodySerialNumber)
    lensSerialNumber = exif.text(TIFFTag.lensSerialNumber)
    focalLength = exif.number(TIFFTag.focalLength, in: Self.focalLengths)
    focalLengthIn35mmFilm = exif.number(
      TIFFTag.focalLengthIn35mmFilm, in: Self.focalLengthsIn35mmFilm)
    focalPlaneResolution = Self.focalPlaneResolution(exif)
    originalWidth = exif.integer(TIFFTag.pixelWidth).flatMap { $0 > 0 ? $0 : nil }
    originalHeight = exif.integer(TIFFTag.pixelHeight).flatMap { $0 > 0 ? $0 : nil }
    captureTime = exif.text(TIFFTag.dateTimeOriginal) ?? image.text(TIFFTag.dateTime)
    position = Self.position(Fields(tiff, image.integer(TIFFTag.gpsDirectory) ?? 0))
    // The front camera looks the other way, and its photos may be mirrored.
    if lens?.contains("front") != true { acceleration = exif.acceleration }
  }

  /// Pixels per millimeter. Resolution units 2 and none: inch; 3: centimeter; 4: millimeter; 5:
  /// micrometer.
  private static func focalPlaneResolution(_ exif: Fields) -> Double? {
    let unit = exif.integer(TIFFTag.focalPlaneResolutionUnit) ?? 2
    guard let millimeters = [2: 25.4, 3: 10, 4: 1, 5: 0.001][unit],
      let value = exif.number(TIFFTag.focalPlaneXResolution, in: 1e-3...1e9)
    else { return nil }
    return value / millimeters
  }

  /// The position; nil for (0, 0), which cameras without reception write.
  private static func position(_ gps: Fields) -> GeographicPosition? {
    guard let latitude = gps.degrees(TIFFTag.latitude),
      let longitude = gps.degrees(TIFFTag.longitude),
      latitude <= 90, longitude <= 180, latitude != 0 || longitude != 0
    else { return nil }
    let altitude = gps.number(TIFFTag.altitude, in: 0...20000)
    return GeographicPosition(
      latitudeDegrees: gps.text(TIFFTag.latitudeReference) == "S" ? -latitude : latitude,
      longitudeDegrees: gps.text(TIFFTag.longitudeReference) == "W" ? -longitude : longitude,
      altitude: altitude.map { gps.integer(TIFFTag.altitudeReference) == 1 ? -$0 : $0 })
  }
}

/// The fields of one directory, by tag.
private struct Fields {
  private let tiff: TIFFStructure
  private let entries: [TIFFStructure.Entry]

  init(_ tiff: TIFFStructure, _ directory: Int) {
    self.tiff = tiff
    entries = tiff.entries(ofDirectoryAt: directory)
  }

  private func entry(_ tag: Int) -> TIFFStructure.Entry? { entries.first { $0.tag == tag } }

  func integer(_ tag: Int) -> Int? { entry(tag).flatMap { tiff.integer($0) } }

  /// The reading of the accelerometer in the maker note of an EXIF directory.
  var acceleration: SIMD3<Double>? {
    guard let note = entry(TIFFTag.makerNote),
      let directory = TIFFStructure(appleMakerNote: note, in: tiff),
      let entry = directory.entries(ofDirectoryAt: directory.firstDirectory)
        .first(where: { $0.tag == TIFFTag.accelerationVector }),
      let x = directory.number(entry, 0), let y = directory.number(entry, 1),
      let z = directory.number(entry, 2)
    else { return nil }
    let vector = SIMD3(x, y, z)
    return vector.length.isFinite ? vector : nil
  }

  func text(_ tag: Int) -> String? { entry(tag).flatMap { tiff.text($0) } }

  /// A number; nil outside its plausible range.
  func number(_ tag: Int, in range: ClosedRange<Double>) -> Double? {
    entry(tag).flatMap { tiff.number($0) }.flatMap { range.contains($0) ? $0 : nil }
  }

  /// An angle stored as degrees, minutes and seconds; missing trailing parts count as zero.
  func degrees(_ tag: Int) -> Double? {
    guard let entry = entry(tag), let degrees = tiff.number(entry) else { return nil }
    let value =
      degrees + (tiff.number(entry, 1) ?? 0) / 60 + (tiff.number(entry, 2) ?? 0) / 3600
    return value.isFinite && value >= 0 ? value : nil
  }
}

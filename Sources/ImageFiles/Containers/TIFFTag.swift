/// Tags of the fields that are read (TIFF 6.0, CIPA DC-008).
enum TIFFTag {
  // The image.
  static let subfileType = 254
  static let imageWidth = 256
  static let imageHeight = 257
  static let photometricInterpretation = 262
  static let make = 271
  static let model = 272
  static let orientation = 274
  static let dateTime = 306
  static let subdirectories = 330
  static let extraSamples = 338
  static let exifDirectory = 34665
  static let colorProfile = 34675
  static let gpsDirectory = 34853
  /// Present in DNG files only.
  static let dngVersion = 50706

  // The EXIF directory.
  static let dateTimeOriginal = 36867
  static let focalLength = 37386
  static let makerNote = 37500
  static let colorSpace = 40961
  static let pixelWidth = 40962
  static let pixelHeight = 40963
  static let interoperabilityDirectory = 40965
  static let focalPlaneXResolution = 41486
  static let focalPlaneResolutionUnit = 41488
  static let focalLengthIn35mmFilm = 41989
  static let bodySerialNumber = 42033
  static let lensModel = 42036
  static let lensSerialNumber = 42037

  // The maker note of Apple's phones.
  static let accelerationVector = 8

  // The GPS directory.
  static let latitudeReference = 1
  static let latitude = 2
  static let longitudeReference = 3
  static let longitude = 4
  static let altitudeReference = 5
  static let altitude = 6

  // The interoperability directory.
  static let interoperabilityIndex = 1
}

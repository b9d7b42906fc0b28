import Foundation
import ImageFiles

extension CGImageSource {
  /// The EXIF orientation; `up` if the file has none.
  var orientation: CGImagePropertyOrientation {
    CGImagePropertyOrientation(rawValue: UInt32(PhotoMetadata(bytes).orientation)) ?? .up
  }

  /// The image properties with numbers as `NSNumber`, so that programs can cast them to any numeric
  /// type.
  var properties: [CFString: Any]? {
    guard let header else { return nil }
    var properties = PhotoMetadata(bytes).imageProperties
    add(additionalFields, to: &properties)
    properties[kCGImagePropertyPixelWidth] = NSNumber(value: header.width)
    properties[kCGImagePropertyPixelHeight] = NSNumber(value: header.height)
    properties[kCGImagePropertyDepth] = NSNumber(value: 8)
    properties[kCGImagePropertyColorModel] =
      isGray ? kCGImagePropertyColorModelGray : kCGImagePropertyColorModelRGB
    properties[kCGImagePropertyHasAlpha] =
      ImageHeader.declaresAlpha(bytes) ? NSNumber(value: true) : nil
    return properties
  }
}

extension CGImageSource {
  /// EXIF and TIFF fields that the reconstruction doesn't use but programs display.
  private var additionalFields: [(directory: CFString, key: CFString, value: Any?)] {
    guard let tiff = TIFFStructure(exifOf: ByteReader(bytes)) else { return [] }
    let image = tiff.entries(ofDirectoryAt: tiff.firstDirectory)
    let link = image.first { $0.tag == 34665 }.flatMap { tiff.integer($0) }
    let exif = link.map { tiff.entries(ofDirectoryAt: $0) } ?? []
    func text(_ tag: Int, _ entries: [TIFFStructure.Entry]) -> Any? {
      entries.first { $0.tag == tag }.flatMap { tiff.text($0) }
    }
    func number(_ tag: Int) -> NSNumber? {
      exif.first { $0.tag == tag }.flatMap { tiff.number($0) }.map { NSNumber(value: $0) }
    }
    let numbers: [(CFString, Int)] = [
      (kCGImagePropertyExifExposureTime, 33434), (kCGImagePropertyExifFNumber, 33437),
      (kCGImagePropertyExifExposureProgram, 34850), (kCGImagePropertyExifShutterSpeedValue, 37377),
      (kCGImagePropertyExifApertureValue, 37378), (kCGImagePropertyExifBrightnessValue, 37379),
      (kCGImagePropertyExifExposureBiasValue, 37380),
      (kCGImagePropertyExifMaxApertureValue, 37381), (kCGImagePropertyExifSubjectDistance, 37382),
      (kCGImagePropertyExifMeteringMode, 37383), (kCGImagePropertyExifLightSource, 37384),
      (kCGImagePropertyExifFlash, 37385), (kCGImagePropertyExifColorSpace, 40961),
      (kCGImagePropertyExifExposureMode, 41986), (kCGImagePropertyExifWhiteBalance, 41987),
      (kCGImagePropertyExifDigitalZoomRatio, 41988), (kCGImagePropertyExifSceneCaptureType, 41990),
    ]
    return numbers.map { (kCGImagePropertyExifDictionary, $0, number($1)) } + [
      (kCGImagePropertyTIFFDictionary, kCGImagePropertyTIFFArtist, text(315, image)),
      (kCGImagePropertyTIFFDictionary, kCGImagePropertyTIFFCopyright, text(33432, image)),
      (kCGImagePropertyTIFFDictionary, kCGImagePropertyTIFFDateTime, text(306, image)),
      (kCGImagePropertyTIFFDictionary, kCGImagePropertyTIFFSoftware, text(305, image)),
      (
        kCGImagePropertyExifDictionary, kCGImagePropertyExifISOSpeedRatings,
        number(34855).map { [$0] }
      ),
      (kCGImagePropertyExifDictionary, kCGImagePropertyExifLensMake, text(42035, exif)),
      (kCGImagePropertyExifDictionary, kCGImagePropertyExifDateTimeDigitized, text(36868, exif)),
      (kCGImagePropertyExifDictionary, kCGImagePropertyExifOffsetTimeOriginal, text(36881, exif)),
      (kCGImagePropertyExifDictionary, kCGImagePropertyExifSubsecTimeOriginal, text(37521, exif)),
    ]
  }

  private func add(
    _ fields: [(directory: CFString, key: CFString, value: Any?)],
    to properties: inout [CFString: Any]
  ) {
    for field in fields {
      guard let value = field.value else { continue }
      var directory = properties[field.directory] as? [CFString: Any] ?? [:]
      directory[field.key] = value
      properties[field.directory] = directory
    }
  }
}

extension PhotoMetadata {
  /// The metadata of a photo with ImageIO's keys; used for files and for samples made from them.
  package var imageProperties: [String: Any] {
    var properties: [String: Any] = [:]
    properties[kCGImagePropertyOrientation] = NSNumber(value: orientation)
    var tiff: [String: Any] = [:]
    tiff[kCGImagePropertyTIFFMake] = make
    tiff[kCGImagePropertyTIFFModel] = model
    tiff[kCGImagePropertyTIFFOrientation] = NSNumber(value: orientation)
    properties[kCGImagePropertyTIFFDictionary] = tiff
    var exif: [String: Any] = [:]
    exif[kCGImagePropertyExifLensModel] = lens
    exif[kCGImagePropertyExifBodySerialNumber] = bodySerialNumber
    exif[kCGImagePropertyExifLensSerialNumber] = lensSerialNumber
    exif[kCGImagePropertyExifFocalLength] = focalLength.map { NSNumber(value: $0) }
    exif[kCGImagePropertyExifFocalLenIn35mmFilm] = focalLengthIn35mmFilm.map { NSNumber(value: $0) }
    exif[kCGImagePropertyExifDateTimeOriginal] = captureTime
    exif[kCGImagePropertyExifPixelXDimension] = originalWidth.map { NSNumber(value: $0) }
    exif[kCGImagePropertyExifPixelYDimension] = originalHeight.map { NSNumber(value: $0) }
    properties[kCGImagePropertyExifDictionary] = exif
    guard let position else { return properties }
    let (latitude, longitude) = (position.latitudeDegrees, position.longitudeDegrees)
    var gps: [String: Any] = [
      kCGImagePropertyGPSLatitude: NSNumber(value: abs(latitude)),
      kCGImagePropertyGPSLongitude: NSNumber(value: abs(longitude)),
      kCGImagePropertyGPSLatitudeRef: latitude < 0 ? "S" : "N",
      kCGImagePropertyGPSLongitudeRef: longitude < 0 ? "W" : "E",
    ]
    if let altitude = position.altitude {
      gps[kCGImagePropertyGPSAltitude] = NSNumber(value: abs(altitude))
      gps[kCGImagePropertyGPSAltitudeRef] = NSNumber(value: altitude < 0 ? 1 : 0)
    }
    properties[kCGImagePropertyGPSDictionary] = gps
    return properties
  }
}

import SceneModel

extension PhotogrammetrySample {
  /// The metadata that the reconstruction uses, read with ImageIO's keys. Fields are numbered by
  /// their EXIF tags.
  var exif: ExifWriter {
    var exif = ExifWriter()
    let tiff = section(kCGImagePropertyTIFFDictionary)
    let camera = section(kCGImagePropertyExifDictionary)
    exif.image[271] = text(tiff[kCGImagePropertyTIFFMake])
    exif.image[272] = text(tiff[kCGImagePropertyTIFFModel])
    exif.image[274] = .short(UInt16(storedOrientation.rawValue))
    exif.camera[42033] = text(camera[kCGImagePropertyExifBodySerialNumber])
    exif.camera[42036] = text(camera[kCGImagePropertyExifLensModel])
    exif.camera[42037] = text(camera[kCGImagePropertyExifLensSerialNumber])
    let lengths = focalLengths(camera)
    exif.camera[37386] = lengths.exact.map { .rationals([$0]) }
    exif.camera[41989] = lengths.film.map { .short(UInt16(clamping: Int(saturating: $0))) }
    exif.gps = gps(section(kCGImagePropertyGPSDictionary))
    return exif
  }

  /// The EXIF orientation of the stored pixels: from the sample's file, else from the metadata.
  var storedOrientation: CGImagePropertyOrientation {
    guard orientation == .up, let number = number(metadata[kCGImagePropertyOrientation]) else {
      return orientation
    }
    return UInt32(exactly: number).flatMap(CGImagePropertyOrientation.init(rawValue:)) ?? .up
  }

  /// The focal length and the 35 mm equivalent, in millimeters. Known intrinsics are expressed as
  /// those of a camera with 35 mm film.
  private func focalLengths(_ camera: [String: Any]) -> (exact: Double?, film: Double?) {
    if let intrinsics = self.camera?.intrinsics, intrinsics[0, 0] > 0 {
      let film = Double(intrinsics[0, 0]) / Double(max(image.width, image.height)) * 36
      return (film, film)
    }
    return (
      number(camera[kCGImagePropertyExifFocalLength]),
      number(camera[kCGImagePropertyExifFocalLenIn35mmFilm])
    )
  }

  private func gps(_ gps: [String: Any]) -> [UInt16: ExifWriter.Value] {
    guard let latitude = number(gps[kCGImagePropertyGPSLatitude]),
      let longitude = number(gps[kCGImagePropertyGPSLongitude])
    else { return [:] }
    var fields: [UInt16: ExifWriter.Value] = [
      1: text(gps[kCGImagePropertyGPSLatitudeRef]) ?? .text(latitude < 0 ? "S" : "N"),
      2: .rationals([abs(latitude), 0, 0]),
      3: text(gps[kCGImagePropertyGPSLongitudeRef]) ?? .text(longitude < 0 ? "W" : "E"),
      4: .rationals([abs(longitude), 0, 0]),
    ]
    if let altitude = number(gps[kCGImagePropertyGPSAltitude]) {
      fields[6] = .rationals([abs(altitude)])
    }
    return fields
  }

  /// A section of the metadata; metadata built by programs often has no sections, so the top level
  /// is the fallback.
  private func section(_ key: String) -> [String: Any] {
    metadata[key] as? [String: Any] ?? metadata
  }

  private func text(_ value: Any?) -> ExifWriter.Value? { (value as? String).map { .text($0) } }

  private func number(_ value: Any?) -> Double? {
    switch value {
    case let value as Double: value.isFinite ? value : nil
    case let value as Float: value.isFinite ? Double(value) : nil
    case let value as Int: Double(value)
    case let value as UInt32: Double(value)
    case let value as NSNumber: value.doubleValue.isFinite ? value.doubleValue : nil
    case let values as [Any]: number(values.first)
    default: nil
    }
  }
}

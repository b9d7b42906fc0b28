import SceneModel

/// Format and size of an image file, read from its header without decoding.
///
/// File names are ignored. All reads are bounds-checked.
package struct ImageHeader: Hashable, Sendable {
  /// The format that the content has.
  package var format: Format
  /// Size in pixels as decoded, before EXIF orientation.
  package var width: Int
  package var height: Int

  package init(format: Format, width: Int, height: Int) {
    self.format = format
    self.width = width
    self.height = height
  }

  /// Reads the header of a file's content.
  ///
  /// Throws `unsupportedFormat` for other image formats, `notAnImage` for other files, and
  /// `damaged` for a damaged header of one of the formats above.
  package init(_ bytes: [UInt8]) throws(ImageError) {
    let reader = ByteReader(bytes)
    guard !bytes.isEmpty else { throw .damaged("the file is empty") }
    if reader.hasPrefix([0xFF, 0xD8, 0xFF]) {
      self = try Self.jpeg(reader)
    } else if reader.hasPrefix([0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A]) {
      self = try Self.png(reader)
    } else if reader.hasPrefix("BM"), bytes.count >= 2, reader.uint32(14, .little) != nil {
      self = try Self.bmp(reader)
    } else if reader.isWebP {
      self = try Self.webP(reader)
    } else if let heif = HEIFFile.Kind(reader) {
      self = try Self.heif(heif, bytes)
    } else if OpenEXRFile.isOpenEXR(reader) {
      let info = try OpenEXRFile.inspect(bytes)
      self = ImageHeader(format: .openEXR, width: info.width, height: info.height)
    } else if CameraRawFile.isRaw(reader) {
      let info = try CameraRawFile.inspect(bytes)
      self = ImageHeader(format: .cameraRaw, width: Int(info.width), height: Int(info.height))
    } else if let tiff = TIFFStructure(reader) {
      self = try Self.tiff(tiff)
    } else {
      throw Self.unsupported(reader)
    }
    guard width > 0, height > 0 else { throw .damaged("its header specifies no pixels") }
  }

  private static func jpeg(_ reader: ByteReader) throws(ImageError) -> ImageHeader {
    for segment in JPEGSegments(reader) where segment.isStartOfFrame {
      let start = segment.payload.lowerBound
      guard let height = reader.uint16(start + 1, .big), let width = reader.uint16(start + 3, .big)
      else { break }
      return ImageHeader(format: .jpeg, width: width, height: height)
    }
    throw .damaged("its JPEG header is damaged or cut off")
  }

  private static func png(_ reader: ByteReader) throws(ImageError) -> ImageHeader {
    guard reader.hasText("IHDR", at: 12), let width = reader.uint32(16, .big),
      let height = reader.uint32(20, .big)
    else { throw .damaged("its PNG header is damaged or cut off") }
    return ImageHeader(format: .png, width: width, height: height)
  }

  private static func bmp(_ reader: ByteReader) throws(ImageError) -> ImageHeader {
    let damaged = ImageError.damaged("its BMP header is damaged or cut off")
    guard let size = reader.uint32(14, .little) else { throw damaged }
    if size == 12 {
      guard let width = reader.uint16(18, .little), let height = reader.uint16(20, .little)
      else { throw damaged }
      return ImageHeader(format: .bmp, width: width, height: height)
    }
    guard size >= 16, size <= 1024, let width = reader.uint32(18, .little),
      let height = reader.uint32(22, .little)
    else { throw damaged }
    // A negative height means that the top row comes first.
    let signedHeight = Int(Int32(truncatingIfNeeded: height))
    return ImageHeader(format: .bmp, width: width, height: abs(signedHeight))
  }

  private static func webP(_ reader: ByteReader) throws(ImageError) -> ImageHeader {
    let damaged = ImageError.damaged("its WebP header is damaged or cut off")
    if reader.hasText("VP8X", at: 12) {
      guard let width = reader.uint24(24), let height = reader.uint24(27) else { throw damaged }
      return ImageHeader(format: .webP, width: width + 1, height: height + 1)
    }
    if reader.hasText("VP8L", at: 12) {
      guard let bits = reader.uint32(21, .little) else { throw damaged }
      return ImageHeader(
        format: .webP, width: bits & 0x3FFF + 1, height: (bits >> 14) & 0x3FFF + 1)
    }
    guard reader.hasText("VP8 ", at: 12), let width = reader.uint16(26, .little),
      let height = reader.uint16(28, .little)
    else { throw damaged }
    return ImageHeader(format: .webP, width: width & 0x3FFF, height: height & 0x3FFF)
  }

  private static func heif(
    _ kind: HEIFFile.Kind, _ bytes: [UInt8]
  ) throws(ImageError) -> ImageHeader {
    let format: Format
    switch kind {
    case .image(let found): format = found
    case .sequence: throw .unsupportedFormat("an image sequence")
    }
    let (width, height, _) = try HEIFFile.inspect(bytes, format)
    return ImageHeader(format: format, width: width, height: height)
  }

  private static func tiff(_ tiff: TIFFStructure) throws(ImageError) -> ImageHeader {
    let entries = tiff.entries(ofDirectoryAt: tiff.firstDirectory)
    func value(_ tag: Int) -> Int? {
      entries.first { $0.tag == tag }.flatMap { tiff.integer($0) }
    }
    guard let width = value(TIFFTag.imageWidth), let height = value(TIFFTag.imageHeight) else {
      throw .damaged("its TIFF header is damaged or cut off")
    }
    return ImageHeader(format: .tiff, width: width, height: height)
  }

  /// Whether a file's header indicates an alpha channel: possible in PNG, WebP, HEIF and TIFF
  /// files.
  package static func declaresAlpha(_ bytes: [UInt8]) -> Bool {
    let reader = ByteReader(bytes)
    if reader.isPNG {
      // Gray or color, with alpha.
      return [4, 6].contains(reader.byte(25))
    }
    if reader.isWebP {
      if reader.hasText("VP8X", at: 12) { return (reader.byte(20) ?? 0) & 0x10 != 0 }
      return reader.hasText("VP8L", at: 12) && (reader.byte(24) ?? 0) & 0x10 != 0
    }
    if HEIFFile.Kind(reader) != nil {
      return (try? HEIFFile.inspect(bytes, .heic))?.hasAlpha == true
    }
    if OpenEXRFile.isOpenEXR(reader) { return (try? OpenEXRFile.inspect(bytes))?.hasAlpha == true }
    guard let tiff = TIFFStructure(reader), !CameraRawFile.isRaw(reader) else { return false }
    // Samples in addition to the color channels.
    return tiff.entries(ofDirectoryAt: tiff.firstDirectory).contains {
      $0.tag == TIFFTag.extraSamples
    }
  }

  /// Distinguishes images in unsupported formats from files that aren't images.
  private static func unsupported(_ reader: ByteReader) -> ImageError {
    if reader.hasText("ftyp", at: 4) { return .notAnImage("a video") }
    let images: [(bytes: [UInt8], name: String)] = [
      (Array("GIF8".utf8), "a GIF image"),
      ([0, 0, 0, 12, 0x6A, 0x50], "a JPEG 2000 image"),
      ([0xFF, 0x4F, 0xFF, 0x51], "a JPEG 2000 image"), ([0xFF, 0x0A], "a JPEG XL image"),
      ([0, 0, 0, 12, 0x4A, 0x58, 0x4C], "a JPEG XL image"),
      (Array("8BPS".utf8), "a Photoshop file"), (Array("DDS ".utf8), "a DDS texture"),
    ]
    if let image = images.first(where: { reader.hasPrefix($0.bytes) }) {
      return .unsupportedFormat(image.name)
    }
    let others: [(bytes: [UInt8], name: String)] = [
      (Array("%PDF".utf8), "a PDF document"), ([0x50, 0x4B, 3, 4], "a zip archive"),
      ([0, 0, 1, 0], "an icon"),
    ]
    if let other = others.first(where: { reader.hasPrefix($0.bytes) }) {
      return .notAnImage(other.name)
    }
    return .notAnImage(reader.looksLikeText ? "a text file" : "a file of an unknown kind")
  }
}

import CKernels
import Kernels
import SceneModel

/// The color space of an image file if it isn't sRGB.
///
/// Phones write Display P3, cameras Adobe RGB if set to it. Interpreted as sRGB, such photos look
/// pale, and so would a texture made from them.
package enum ColorProfile: Hashable, Sendable {
  /// Given by an ICC profile (ISO 15076-1) in the file.
  case icc([UInt8])
  /// Adobe RGB (1998), which cameras indicate without a profile (DCF 2.0, section 5.3).
  case adobeRGB

  /// Size in bytes above which a profile is ignored. Chosen: those of cameras have less than 4 kB,
  /// those of scanners up to a few hundred kB.
  private static let maximumSize = 4 << 20

  /// The profile in an image file's content; nil without one, which means sRGB.
  package init?(_ bytes: [UInt8]) {
    let reader = ByteReader(bytes)
    // That of a preview; LibRaw makes sRGB.
    guard !CameraRawFile.isRaw(reader) else { return nil }
    if let profile = Self.profile(reader), profile.count <= Self.maximumSize {
      self = .icc(profile)
    } else if Self.isAdobeRGB(reader) {
      self = .adobeRGB
    } else {
      return nil
    }
  }

  /// Converts an RGB image to sRGB in place; a damaged profile leaves it unchanged.
  package func convert(_ image: inout RasterImage) throws {
    guard image.channels == 3, !image.pixels.isEmpty else { return }
    let count = image.width * image.height
    try image.pixels.withUnsafeMutableBufferPointer { pixels in
      guard let base = pixels.baseAddress else { return }
      try withKernel(KernelControl()) { _ in
        switch self {
        case .icc(let profile):
          ck_image_convert_to_srgb(base, count, ck_color_space_icc, profile, profile.count)
        case .adobeRGB: ck_image_convert_to_srgb(base, count, ck_color_space_adobe_rgb, nil, 0)
        }
      }
    }
  }

  /// The ICC profile of a JPEG, PNG, WebP, HEIF or TIFF file.
  private static func profile(_ reader: ByteReader) -> [UInt8]? {
    if reader.isJPEG { return jpeg(reader) }
    if reader.isPNG { return png(reader) }
    if reader.isWebP {
      return FileChunks(webP: reader).first { $0.name == "ICCP" }.map {
        Array(reader.bytes[$0.data])
      }
    }
    if HEIFFile.Kind(reader) != nil { return HEIFFile.colorProfile(reader.bytes) }
    guard let tiff = TIFFStructure(reader) else { return nil }
    return tiff.entries(ofDirectoryAt: tiff.firstDirectory).first { $0.tag == TIFFTag.colorProfile }
      .flatMap { tiff.bytes($0) }
  }

  /// Concatenates the profile's parts: segments of at most 64 kB, each with its number and the
  /// total.
  private static func jpeg(_ reader: ByteReader) -> [UInt8]? {
    let name = Array("ICC_PROFILE\0".utf8)
    var parts: [Int: Range<Int>] = [:]
    for segment in JPEGSegments(reader)
    where segment.marker == 0xE2 && segment.payload.count > name.count + 2
      && reader.bytes[segment.payload].starts(with: name)
    {
      let start = segment.payload.lowerBound + name.count
      parts[Int(reader.bytes[start])] = start + 2..<segment.payload.upperBound
    }
    guard !parts.isEmpty else { return nil }
    return parts.sorted { $0.key < $1.key }.flatMap { reader.bytes[$0.value] }
  }

  /// The chunk holds a name that ends in zero, a byte for the method, and the deflated profile.
  private static func png(_ reader: ByteReader) -> [UInt8]? {
    guard let chunk = FileChunks(png: reader).first(where: { $0.name == "iCCP" }),
      let end = reader.bytes[chunk.data].prefix(80).firstIndex(of: 0),
      end + 2 < chunk.data.upperBound
    else { return nil }
    let deflated = Array(reader.bytes[end + 2..<chunk.data.upperBound])
    var inflated: OpaquePointer?
    try? withKernel(KernelControl()) { _ in
      ck_inflate(deflated, deflated.count, maximumSize, &inflated)
    }
    let profile = [UInt8](taking: inflated)
    return profile.isEmpty ? nil : profile
  }

  /// EXIF's value of the color space for sRGB.
  private static let sRGB = 1

  /// EXIF has a value for sRGB only: without it, the interoperability index R03 means Adobe RGB.
  private static func isAdobeRGB(_ reader: ByteReader) -> Bool {
    guard let tiff = TIFFStructure(exifOf: reader),
      let exif = tiff.integer(of: TIFFTag.exifDirectory, in: tiff.firstDirectory),
      tiff.integer(of: TIFFTag.colorSpace, in: exif) != sRGB,
      let interoperability = tiff.integer(of: TIFFTag.interoperabilityDirectory, in: exif),
      let index = tiff.entries(ofDirectoryAt: interoperability)
        .first(where: { $0.tag == TIFFTag.interoperabilityIndex })
    else { return false }
    return tiff.text(index) == "R03"
  }
}

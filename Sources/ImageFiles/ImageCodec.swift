import CKernels
import Foundation
import Kernels
import SceneModel

/// Reads and writes image files.
///
/// Reads JPEG, HEIC, PNG, TIFF, BMP, WebP, AVIF, OpenEXR and camera raw files, detected from their
/// content, as 8-bit sRGB: samples of 16 bits are reduced; gray, palette and CMYK images and images
/// with an ICC profile are converted; the linear colors of OpenEXR are clipped at 1. The alpha
/// channel is dropped without changing the colors of transparent pixels; `decodeAlpha` reads it.
///
/// EXIF orientation isn't applied; `RasterImage.turned(byOrientation:)` does that. Only the
/// decoders of TIFF, HEIF and camera raw files rotate images upright, by the orientation in the
/// container.
package enum ImageCodec {
  /// Sizes above which a file is rejected before decoding.
  package struct Limits: Hashable, Codable, Sendable {
    /// Pixels per side. Chosen.
    package var maximumSide = 16384
    /// Pixels per image. Chosen.
    package var maximumPixels = 300_000_000
    /// Bytes per file. Chosen.
    package var maximumFileSize = 1 << 30

    package init() {}

    /// For a decoder.
    var kernelLimits: ck_decode_limits {
      ck_decode_limits(
        maximum_side: Int32(clamping: maximumSide), maximum_pixels: Int64(maximumPixels))
    }
  }

  /// The content of a regular file. Throws `unreadable`.
  package static func contents(
    of url: URL, limits: Limits = Limits()
  ) throws(ImageError) -> [UInt8] {
    let data: Data
    do {
      let values = try url.resolvingSymlinksInPath().resourceValues(
        forKeys: [.isRegularFileKey, .fileSizeKey])
      guard values.isRegularFile == true else { throw ImageError.unreadable("it is not a file") }
      guard values.fileSize ?? 0 <= limits.maximumFileSize else {
        throw ImageError.unreadable("the file is larger than 1 GB")
      }
      data = try Data(contentsOf: url)
    } catch let error as ImageError {
      throw error
    } catch {
      throw .unreadable("check that it exists and its permissions")
    }
    return [UInt8](data)
  }

  /// The divisors of both sides that `decode` supports, ascending.
  package static let reductions = [1, 2, 4, 8]

  /// Decodes the content of an image file, without rotating the pixels.
  ///
  /// `reduction` is one of `reductions`: a JPEG is decoded with its sides divided by it and rounded
  /// up, omitting its highest frequencies, which takes less time; other formats are decoded at full
  /// size.
  package static func decode(
    _ bytes: [UInt8], reducedBy reduction: Int = 1, limits: Limits = Limits()
  ) throws(ImageError) -> RasterImage {
    var image = try decode(bytes, channels: 3, limits) {
      ck_image_decode(bytes, bytes.count, $0, Int32(clamping: reduction), $1, $2)
    }
    do {
      try ColorProfile(bytes)?.convert(&image)
    } catch {
      throw .damaged("its colors can't be converted (\(message(of: error)))")
    }
    return image
  }

  /// Decodes the alpha channel of an image file's content: gray, not rotated, 0 where the image is
  /// transparent. Nil without an alpha channel.
  package static func decodeAlpha(
    _ bytes: [UInt8], limits: Limits = Limits()
  ) throws(ImageError) -> RasterImage? {
    guard ImageHeader.declaresAlpha(bytes) else { return nil }
    let alpha = try decode(bytes, channels: 1, limits) {
      ck_image_decode_alpha(bytes, bytes.count, $0, $1, $2)
    }
    return alpha.pixels.isEmpty ? nil : alpha
  }

  /// Decodes a TIFF or OpenEXR file with one floating-point value per pixel, the top row first.
  package static func decodeNumbers(
    _ bytes: [UInt8], limits: Limits = Limits()
  ) throws(ImageError) -> (width: Int, height: Int, values: [Float]) {
    let colors = ImageError.unsupportedFormat(
      "a color image, where one with a number per pixel is expected")
    guard [.tiff, .openEXR].contains(try ImageHeader(bytes).format) else { throw colors }
    let decoded = try decode(bytes, channels: 4, limits) {
      ck_image_decode_float(bytes, bytes.count, $0, $1, $2)
    }
    guard !decoded.pixels.isEmpty else { throw colors }
    let values = decoded.pixels.withUnsafeBytes { Array($0.bindMemory(to: Float.self)) }
    return (decoded.width, decoded.height, values)
  }

  /// Checks the header against the limits, then decodes with the codec of its format.
  private static func decode(
    _ bytes: [UInt8], channels: Int, _ limits: Limits,
    _ body: (ck_codec, UnsafePointer<ck_decode_limits>, UnsafeMutablePointer<OpaquePointer?>)
      -> ck_status
  ) throws(ImageError) -> RasterImage {
    let header = try ImageHeader(bytes)
    guard header.width <= limits.maximumSide, header.height <= limits.maximumSide,
      header.width * header.height <= limits.maximumPixels
    else { throw .tooLarge(width: header.width, height: header.height) }
    let codec =
      switch header.format {
      case .jpeg: ck_codec_jpeg
      case .png: ck_codec_png
      case .heic, .avif: ck_codec_heif
      case .tiff: ck_codec_tiff
      case .webP: ck_codec_webp
      case .bmp: ck_codec_bmp
      case .cameraRaw: ck_codec_raw
      case .openEXR: ck_codec_exr
      }
    var image: OpaquePointer?
    do {
      try withKernel(KernelControl()) { _ in
        withUnsafePointer(to: limits.kernelLimits) { body(codec, $0, &image) }
      }
    } catch {
      if let specific = header.format.error(for: error) { throw specific }
      throw .damaged("its \(header.format.rawValue) data is damaged (\(message(of: error)))")
    }
    guard let image else { throw .damaged("it can't be decoded") }
    defer { ck_image_free(image) }
    let (width, height) = (Int(ck_image_width(image)), Int(ck_image_height(image)))
    let byteCount = width * height * channels
    let pixels = [UInt8](unsafeUninitializedCapacity: byteCount) { buffer, count in
      if let base = buffer.baseAddress, byteCount > 0 { ck_image_copy(image, base) }
      count = byteCount
    }
    return RasterImage(width: width, height: height, channels: channels, pixels: pixels)
  }

  /// Encodes gray, RGB or RGBA as PNG; deterministic.
  package static func encodePNG(_ image: RasterImage) throws -> [UInt8] {
    try encode(image, ck_codec_png, quality: 0)
  }

  /// Encodes gray or RGB as JPEG; deterministic. `quality` is 0…1.
  package static func encodeJPEG(_ image: RasterImage, quality: Float) throws -> [UInt8] {
    try encode(image, ck_codec_jpeg, quality: percent(quality))
  }

  /// How WebP stores pixels.
  package enum WebPQuality: Hashable, Codable, Sendable {
    case lossless
    /// `quality` is 0…1.
    case lossy(quality: Float)
  }

  /// The largest width and height of a WebP file. Limit: the format has 14 bits.
  package static let maximumWebPSide = 16383

  /// Encodes gray or RGB as WebP; deterministic.
  package static func encodeWebP(_ image: RasterImage, _ quality: WebPQuality) throws -> [UInt8] {
    let options =
      switch quality {
      case .lossless: ck_webp_options(is_lossless: true, quality: 75, is_sharp: false)
      case .lossy(let quality):
        ck_webp_options(is_lossless: false, quality: percent(quality), is_sharp: true)
      }
    var encoded: OpaquePointer?
    try withKernel(KernelControl()) { _ in
      withUnsafePointer(to: options) { options in
        image.withKernelPixels { ck_webp_encode($0, options, &encoded) }
      }
    }
    return [UInt8](taking: encoded)
  }

  /// The contents of a HEIC file besides its pixels.
  package struct HEICContent: Hashable, Sendable {
    /// 0…1. Chosen.
    package var quality: Float = 0.9
    /// As in EXIF, 1…8: how the pixels must be rotated for display.
    package var orientation = 1
    /// EXIF data, starting at its TIFF header.
    package var exif: [UInt8] = []
    /// An ICC profile; empty means sRGB.
    package var colorProfile: [UInt8] = []
    /// An XMP packet.
    package var xmp: [UInt8] = []

    package init() {}
  }

  /// Encodes RGB or RGBA as HEIC.
  package static func encodeHEIC(
    _ image: RasterImage, _ content: HEICContent = HEICContent()
  ) throws -> [UInt8] {
    var encoded: OpaquePointer?
    try content.exif.withUnsafeBufferPointer { exif in
      try content.colorProfile.withUnsafeBufferPointer { profile in
        try content.xmp.withUnsafeBufferPointer { xmp in
          var options = ck_heif_options(
            quality: percent(content.quality), orientation: Int32(clamping: content.orientation),
            exif: exif.isEmpty ? nil : exif.baseAddress, exif_count: exif.count,
            color_profile: profile.isEmpty ? nil : profile.baseAddress,
            color_profile_count: profile.count,
            xmp: xmp.isEmpty ? nil : xmp.baseAddress, xmp_count: xmp.count)
          try withKernel(KernelControl()) { _ in
            image.withKernelPixels { ck_heif_encode($0, &options, &encoded) }
          }
        }
      }
    }
    return [UInt8](taking: encoded)
  }

  /// Converts a quality of 0…1 to percent; infinity and NaN count as 1.
  private static func percent(_ quality: Float) -> Int32 {
    Int32((min(max(quality.isFinite ? quality : 1, 0), 1) * 100).rounded())
  }

  private static func encode(
    _ image: RasterImage, _ codec: ck_codec, quality: Int32
  ) throws -> [UInt8] {
    var encoded: OpaquePointer?
    try withKernel(KernelControl()) { _ in
      image.withKernelPixels { ck_image_encode($0, codec, quality, &encoded) }
    }
    return [UInt8](taking: encoded)
  }

  private static func message(of error: any Error) -> String {
    (error as? KernelError)?.description ?? "unknown reason"
  }
}

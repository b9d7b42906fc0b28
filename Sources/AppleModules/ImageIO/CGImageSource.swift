// swift-format-ignore-file: AlwaysUseLowerCamelCase
@_exported import BitmapGraphics
@_exported import CoreFoundationTypes
import ImageFiles
import Kernels
import SceneModel

/// The content of an image file: JPEG, PNG, TIFF, BMP, WebP, HEIC or AVIF with one image each.
public final class CGImageSource: Sendable {
  let bytes: [UInt8]
  let header: ImageHeader?

  init(_ bytes: [UInt8]) {
    self.bytes = bytes
    header = try? ImageHeader(bytes)
  }

  /// Decodes the pixels as stored; nil if the file is damaged.
  func image() -> RasterImage? {
    guard header != nil, let image = try? ImageCodec.decode(bytes) else { return nil }
    guard let alpha = try? ImageCodec.decodeAlpha(bytes),
      alpha.pixels.count * 3 == image.pixels.count
    else { return isGray ? image.gray : image }
    var pixels: [UInt8] = []
    pixels.reserveCapacity(alpha.pixels.count * 4)
    for index in alpha.pixels.indices {
      pixels += image.pixels[3 * index..<3 * index + 3]
      pixels.append(alpha.pixels[index])
    }
    return RasterImage(width: image.width, height: image.height, channels: 4, pixels: pixels)
  }

  /// Whether the header declares a grayscale image.
  var isGray: Bool {
    switch header?.format {
    case .png: bytes.count > 25 && bytes[25] & 2 == 0 && bytes[25] & 1 == 0
    case .jpeg:
      JPEGSegments(ByteReader(bytes)).first { $0.isStartOfFrame }
        .map {
          bytes.indices.contains($0.payload.lowerBound + 5)
            && bytes[$0.payload.lowerBound + 5] == 1
        } ?? false
    default: false
    }
  }
}

/// Reads an image file; nil if it can't be read. Options have no effect.
public func CGImageSourceCreateWithURL(_ url: CFURL, _ options: CFDictionary?) -> CGImageSource? {
  (try? ImageCodec.contents(of: url)).map { CGImageSource($0) }
}

/// Creates a source from the content of an image file. Options have no effect.
public func CGImageSourceCreateWithData(_ data: CFData, _ options: CFDictionary?) -> CGImageSource?
{
  CGImageSource([UInt8](data))
}

/// The number of images: 1, or 0 if the format is not supported.
public func CGImageSourceGetCount(_ isrc: CGImageSource) -> Int { isrc.header == nil ? 0 : 1 }

/// The index of the primary image: always 0.
public func CGImageSourceGetPrimaryImageIndex(_ isrc: CGImageSource) -> Int { 0 }

/// The uniform type identifier of the format; nil if it is not supported.
public func CGImageSourceGetType(_ isrc: CGImageSource) -> CFString? {
  switch isrc.header?.format {
  case .jpeg: "public.jpeg"
  case .png: "public.png"
  case .tiff: "public.tiff"
  case .bmp: "com.microsoft.bmp"
  case .webP: "org.webmproject.webp"
  case .heic: "public.heic"
  case .avif: "public.avif"
  case .cameraRaw: "public.camera-raw-image"
  case .openEXR: "com.ilm.openexr-image"
  case nil: nil
  }
}

/// Whether the file can be read.
public func CGImageSourceGetStatus(_ isrc: CGImageSource) -> CGImageSourceStatus {
  isrc.header == nil ? .statusUnknownType : .statusComplete
}

/// The properties of the file itself: its size in bytes.
public func CGImageSourceCopyProperties(
  _ isrc: CGImageSource, _ options: CFDictionary?
) -> CFDictionary? { [kCGImagePropertyFileSize: NSNumber(value: isrc.bytes.count)] }

/// The properties of an image: its size and its EXIF, TIFF and GPS metadata.
public func CGImageSourceCopyPropertiesAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ options: CFDictionary?
) -> CFDictionary? { index == 0 ? isrc.properties : nil }

/// The pixels as stored, without applying the orientation.
public func CGImageSourceCreateImageAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ options: CFDictionary?
) -> CGImage? { index == 0 ? isrc.image().map { CGImage($0) } : nil }

/// A thumbnail made from the full image. Options: `kCGImageSourceThumbnailMaxPixelSize` is the
/// longer side in pixels, `kCGImageSourceCreateThumbnailWithTransform` rotates it upright; others
/// have no effect.
public func CGImageSourceCreateThumbnailAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ options: CFDictionary?
) -> CGImage? {
  guard index == 0, let image = isrc.image() else { return nil }
  let side = (options?[kCGImageSourceThumbnailMaxPixelSize] as? NSNumber)?.doubleValue
  let isTurned = options?[kCGImageSourceCreateThumbnailWithTransform] as? Bool ?? false
  let longest = Double(max(image.width, image.height))
  let scale = side.map { $0 >= 1 ? min(1, $0 / longest) : 1 } ?? 1
  func scaled(_ length: Int) -> Int { max(1, Int((Double(length) * scale).rounded())) }
  let small = try? image.resized(width: scaled(image.width), height: scaled(image.height))
  let orientation = isTurned ? Int(isrc.orientation.rawValue) : 1
  return (try? small?.turned(byOrientation: orientation)).map { CGImage($0) }
}

/// Auxiliary data such as depth: always nil, it is not read here.
public func CGImageSourceCopyAuxiliaryDataInfoAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ auxiliaryImageDataType: CFString
) -> CFDictionary? { nil }

/// The reading status of a source.
public enum CGImageSourceStatus: Int32, Hashable, Sendable {
  /// The file is truncated.
  case statusUnexpectedEOF = -5
  /// The file is damaged.
  case statusInvalidData
  /// The format is not supported.
  case statusUnknownType
  /// The header is being read.
  case statusReadingHeader
  /// The image is incomplete.
  case statusIncomplete
  /// The image is complete.
  case statusComplete
}

// swift-format-ignore-file: AlwaysUseLowerCamelCase
@_exported import BitmapGraphics
@_exported import CoreFoundationTypes
import ImageFiles
import Kernels
import SceneModel

/// The content of an image file: JPEG, PNG, TIFF, BMP or WebP, one image each.
public final class CGImageSource: Sendable {
  let bytes: [UInt8]
  let header: ImageHeader?

  init(_ bytes: [UInt8]) {
    self.bytes = bytes
    header = try? ImageHeader(bytes)
  }

  /// The pixels as stored.
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

  /// Whether the file says that it has grays only.
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

/// Reads an image file; nil where it can't be read. Options have no effect.
public func CGImageSourceCreateWithURL(_ url: CFURL, _ options: CFDictionary?) -> CGImageSource? {
  (try? ImageCodec.contents(of: url)).map { CGImageSource($0) }
}

/// Takes the content of an image file. Options have no effect.
public func CGImageSourceCreateWithData(_ data: CFData, _ options: CFDictionary?) -> CGImageSource?
{
  CGImageSource([UInt8](data))
}

/// The number of images: 1, or 0 where the file is of another kind.
public func CGImageSourceGetCount(_ isrc: CGImageSource) -> Int { isrc.header == nil ? 0 : 1 }

/// The place of the image that stands for all: the only one.
public func CGImageSourceGetPrimaryImageIndex(_ isrc: CGImageSource) -> Int { 0 }

/// The uniform type identifier of the file; nil where it is of another kind.
public func CGImageSourceGetType(_ isrc: CGImageSource) -> CFString? {
  switch isrc.header?.format {
  case .jpeg: "public.jpeg"
  case .png: "public.png"
  case .tiff: "public.tiff"
  case .bmp: "com.microsoft.bmp"
  case .webP: "org.webmproject.webp"
  case .heic: "public.heic"
  case .avif: "public.avif"
  case nil: nil
  }
}

/// Whether the file can be read.
public func CGImageSourceGetStatus(_ isrc: CGImageSource) -> CGImageSourceStatus {
  isrc.header == nil ? .statusUnknownType : .statusComplete
}

/// What is known of the file besides its image: its size in bytes.
public func CGImageSourceCopyProperties(
  _ isrc: CGImageSource, _ options: CFDictionary?
) -> CFDictionary? { [kCGImagePropertyFileSize: NSNumber(value: isrc.bytes.count)] }

/// What is known of an image: its size, and what the camera wrote into it.
public func CGImageSourceCopyPropertiesAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ options: CFDictionary?
) -> CFDictionary? { index == 0 ? isrc.properties : nil }

/// The pixels of an image as stored, whatever the orientation.
public func CGImageSourceCreateImageAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ options: CFDictionary?
) -> CGImage? { index == 0 ? isrc.image().map { CGImage($0) } : nil }

/// A smaller image, made from the whole: `kCGImageSourceThumbnailMaxPixelSize` is the longer side,
/// and `kCGImageSourceCreateThumbnailWithTransform` turns it upright. Other options have no effect.
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

/// Depth and the like that comes with an image: there is none in the kinds of files above.
public func CGImageSourceCopyAuxiliaryDataInfoAtIndex(
  _ isrc: CGImageSource, _ index: Int, _ auxiliaryImageDataType: CFString
) -> CFDictionary? { nil }

/// How far a file is read.
public enum CGImageSourceStatus: Int32, Hashable, Sendable {
  /// It ends too early.
  case statusUnexpectedEOF = -5
  /// It is damaged.
  case statusInvalidData
  /// It is of a kind that can't be read.
  case statusUnknownType
  /// Its header is being read.
  case statusReadingHeader
  /// It is being read.
  case statusIncomplete
  /// All of it was read.
  case statusComplete
}

@_exported import BitmapGraphics
@_exported import CoreVideo
@_exported import Foundation
@_exported import ImageIO
import SceneModel

/// An image in a plane: it may be rotated, cropped, translated and scaled before it is rendered.
/// There are no filters.
public final class CIImage: Sendable {
  /// The pixels if the image is neither transformed nor cropped; nil otherwise.
  public let cgImage: CGImage?
  /// The URL of the file that the image was read from.
  public let url: URL?
  /// The metadata with ImageIO's keys.
  public var properties: [String: Any] { source?.values ?? [:] }

  let pixels: CGImage
  /// Maps the pixels, with y up from the bottom left corner, to the plane.
  let transform: CGAffineTransform
  /// The visible rectangle.
  let bounds: CGRect
  private let source: Properties?

  /// Metadata that is safe to share: immutable after initialization.
  final class Properties: @unchecked Sendable {
    let values: [String: Any]

    init(_ values: [String: Any]) { self.values = values }
  }

  private init(
    _ pixels: CGImage, _ transform: CGAffineTransform, _ bounds: CGRect, _ url: URL?,
    _ source: Properties?
  ) {
    (self.pixels, self.transform, self.bounds, self.url) = (pixels, transform, bounds, url)
    self.source = source
    cgImage = transform.isIdentity && bounds == pixels.frame ? pixels : nil
  }

  private convenience init?(_ source: CGImageSource?, _ url: URL?, _ options: [CIImageOption: Any]?)
  {
    guard let source, let pixels = CGImageSourceCreateImageAtIndex(source, 0, nil) else {
      return nil
    }
    let properties = CGImageSourceCopyPropertiesAtIndex(source, 0, nil) ?? [:]
    let number = (properties[kCGImagePropertyOrientation] as? NSNumber)?.uint32Value ?? 1
    let appliesOrientation = options?[.applyOrientationProperty] as? Bool ?? false
    let orientation = appliesOrientation ? CGImagePropertyOrientation(rawValue: number) ?? .up : .up
    let transform = orientation.transform(of: pixels.frame.size)
    self.init(
      pixels, transform, pixels.frame.applying(transform), url, Properties(properties))
  }

  /// Reads an image file; nil if it can't be read.
  public convenience init?(contentsOf url: URL, options: [CIImageOption: Any]? = nil) {
    self.init(CGImageSourceCreateWithURL(url, nil), url, options)
  }

  /// Reads an image file in memory; nil if it can't be read.
  public convenience init?(data: Data, options: [CIImageOption: Any]? = nil) {
    self.init(CGImageSourceCreateWithData(data, nil), nil, options)
  }

  /// Creates an image from pixels.
  public convenience init(cgImage: CGImage, options: [CIImageOption: Any]? = nil) {
    self.init(cgImage, .identity, cgImage.frame, nil, nil)
  }

  /// Creates an image from the current content of a buffer; black if its format is neither RGB nor
  /// `OneComponent8`.
  public convenience init(cvPixelBuffer pixelBuffer: CVPixelBuffer) {
    let raster = pixelBuffer.image ?? pixelBuffer.grayImage
    let pixels = CGImage(
      raster ?? .init(width: pixelBuffer.width, height: pixelBuffer.height, channels: 1))
    self.init(pixels, .identity, pixels.frame, nil, nil)
  }

  /// Creates an image from the current content of a buffer.
  public convenience init(cvImageBuffer imageBuffer: CVImageBuffer) {
    self.init(cvPixelBuffer: imageBuffer)
  }

  /// The rectangle of the image in the plane.
  public var extent: CGRect { bounds }

  /// The image transformed by an affine map.
  public func transformed(by matrix: CGAffineTransform) -> CIImage {
    CIImage(pixels, transform.concatenating(matrix), bounds.applying(matrix), url, source)
  }

  /// The part of the image inside a rectangle.
  public func cropped(to rect: CGRect) -> CIImage {
    CIImage(pixels, transform, bounds.intersection(rect), url, source)
  }

  /// The image rotated upright from an orientation, with its corner at the origin.
  public func oriented(_ orientation: CGImagePropertyOrientation) -> CIImage {
    let home = CGAffineTransform(translationX: -bounds.minX, y: -bounds.minY)
    return transformed(by: home.concatenating(orientation.transform(of: bounds.size)))
  }

  /// The image rotated upright from an EXIF orientation, with its corner at the origin.
  public func oriented(forExifOrientation orientation: Int32) -> CIImage {
    let value = UInt32(exactly: orientation).flatMap(CGImagePropertyOrientation.init(rawValue:))
    return oriented(value ?? .up)
  }
}

/// Options for reading an image.
public struct CIImageOption: RawRepresentable, Hashable, Sendable {
  /// The name of the option.
  public let rawValue: String

  /// Creates an option from its name.
  public init(rawValue: String) { self.rawValue = rawValue }

  /// Whether to rotate the image upright; false by default.
  public static let applyOrientationProperty = CIImageOption(rawValue: "applyOrientationProperty")
}

extension CGImage {
  /// The rectangle of the pixels with the bottom left corner at the origin.
  var frame: CGRect { CGRect(x: 0, y: 0, width: width, height: height) }
}

extension CGImagePropertyOrientation {
  /// The transform that rotates pixels of a given size upright, with y up and the bottom left
  /// corner at the origin before and after.
  func transform(of size: CGSize) -> CGAffineTransform {
    let (w, h) = (size.width, size.height)
    return switch self {
    case .up: .identity
    case .upMirrored: CGAffineTransform(-1, 0, 0, 1, w, 0)
    case .down: CGAffineTransform(-1, 0, 0, -1, w, h)
    case .downMirrored: CGAffineTransform(1, 0, 0, -1, 0, h)
    case .leftMirrored: CGAffineTransform(0, -1, -1, 0, h, w)
    case .right: CGAffineTransform(0, -1, 1, 0, 0, w)
    case .rightMirrored: CGAffineTransform(0, 1, 1, 0, 0, 0)
    case .left: CGAffineTransform(0, 1, -1, 0, h, 0)
    }
  }
}

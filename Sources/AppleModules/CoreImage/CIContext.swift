import BitmapGraphics
import CoreVideo
import ImageIO
import Metal

/// Renders images, with the processor. Options have no effect, and colours are not converted.
public final class CIContext: Sendable {
  /// Creates a context.
  public init(options: [CIContextOption: Any]? = nil) {}

  /// Creates a context that renders with a device: the processor is the only one.
  public init(mtlDevice device: any MTLDevice, options: [CIContextOption: Any]? = nil) {}

  /// Renders an image into a buffer of colours or `OneComponent8`, whose bottom left corner is the
  /// origin; buffers of other kinds stay as they are.
  public func render(_ image: CIImage, to buffer: CVPixelBuffer) {
    let size = CGSize(width: CVPixelBufferGetWidth(buffer), height: CVPixelBufferGetHeight(buffer))
    render(image, to: buffer, bounds: CGRect(origin: .zero, size: size), colorSpace: nil)
  }

  /// Renders the part of an image that is in a rectangle into a buffer.
  public func render(
    _ image: CIImage, to buffer: CVPixelBuffer, bounds: CGRect, colorSpace: CGColorSpace?
  ) {
    guard let (space, info) = layout(CVPixelBufferGetPixelFormatType(buffer)),
      let context = CGContext(
        data: CVPixelBufferGetBaseAddress(buffer), width: CVPixelBufferGetWidth(buffer),
        height: CVPixelBufferGetHeight(buffer), bitsPerComponent: 8,
        bytesPerRow: CVPixelBufferGetBytesPerRow(buffer), space: space, bitmapInfo: info)
    else { return }
    context.draw(image, from: bounds.origin)
  }

  /// The pixels of an image in a rectangle; nil where it is empty or too large.
  public func createCGImage(_ image: CIImage, from fromRect: CGRect) -> CGImage? {
    let part = fromRect.integral
    guard !part.isNull, part.width >= 1, part.height >= 1, part.width <= 65536, part.height <= 65536
    else { return nil }
    let isGray = image.pixels.bitsPerPixel == 8
    let context = CGContext(
      data: nil, width: Int(part.width), height: Int(part.height), bitsPerComponent: 8,
      bytesPerRow: 0,
      space: isGray ? CGColorSpaceCreateDeviceGray() : CGColorSpaceCreateDeviceRGB(),
      bitmapInfo: (isGray ? CGImageAlphaInfo.none : .premultipliedLast).rawValue)
    context?.draw(image, from: part.origin)
    return context?.makeImage()
  }

  /// An image as a JPEG file; nil where it can't be rendered.
  public func jpegRepresentation(
    of image: CIImage, colorSpace: CGColorSpace, options: [CIImageRepresentationOption: Any] = [:]
  ) -> Data? { file(of: image, "public.jpeg", quality(options)) }

  /// An image as a PNG file; nil where it can't be rendered.
  public func pngRepresentation(
    of image: CIImage, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) -> Data? { file(of: image, "public.png", [:]) }

  /// Writes an image as a JPEG file.
  public func writeJPEGRepresentation(
    of image: CIImage, to url: URL, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) throws {
    try write(
      jpegRepresentation(of: image, colorSpace: colorSpace, options: options), to: url)
  }

  /// Writes an image as a PNG file.
  public func writePNGRepresentation(
    of image: CIImage, to url: URL, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) throws {
    try write(file(of: image, "public.png", [:]), to: url)
  }

  /// The image as a HEIC file, of the quality that the options name.
  public func heifRepresentation(
    of image: CIImage, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) -> Data? { file(of: image, "public.heic", quality(options)) }

  /// Writes an image as a HEIC file.
  public func writeHEIFRepresentation(
    of image: CIImage, to url: URL, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) throws {
    try write(
      heifRepresentation(of: image, format: format, colorSpace: colorSpace, options: options),
      to: url)
  }

  /// The option that files have an equivalent of.
  private func quality(_ options: [CIImageRepresentationOption: Any]) -> CFDictionary {
    let key = kCGImageDestinationLossyCompressionQuality
    let value = options[CIImageRepresentationOption(rawValue: key)]
    return value.map { [key: $0] } ?? [:]
  }

  private func write(_ data: Data?, to url: URL) throws {
    guard let data else {
      throw CocoaError(.fileWriteUnknown, userInfo: [NSFilePathErrorKey: url.path])
    }
    try data.write(to: url)
  }

  private func file(of image: CIImage, _ type: CFString, _ properties: CFDictionary) -> Data? {
    let data = NSMutableData()
    guard let pixels = createCGImage(image, from: image.extent),
      let destination = CGImageDestinationCreateWithData(data, type, 1, nil)
    else { return nil }
    CGImageDestinationAddImage(destination, pixels, properties)
    return CGImageDestinationFinalize(destination) ? data as Data : nil
  }

  /// How the pixels of a buffer lie in memory; nil for those that nothing can be drawn into.
  private func layout(_ format: OSType) -> (CGColorSpace, UInt32)? {
    let colours = CGColorSpaceCreateDeviceRGB()
    let first = CGImageAlphaInfo.premultipliedFirst.rawValue
    return switch format {
    case kCVPixelFormatType_32BGRA: (colours, first | CGBitmapInfo.byteOrder32Little.rawValue)
    case kCVPixelFormatType_32ARGB: (colours, first | CGBitmapInfo.byteOrder32Big.rawValue)
    case kCVPixelFormatType_32RGBA: (colours, CGImageAlphaInfo.premultipliedLast.rawValue)
    case kCVPixelFormatType_OneComponent8:
      (CGColorSpaceCreateDeviceGray(), CGImageAlphaInfo.none.rawValue)
    default: nil
    }
  }
}

extension CGContext {
  /// Draws what can be seen of an image, with a point of it at the bottom left corner.
  fileprivate func draw(_ image: CIImage, from origin: CGPoint) {
    clear(CGRect(x: 0, y: 0, width: width, height: height))
    saveGState()
    translateBy(x: -origin.x, y: -origin.y)
    clip(to: image.bounds)
    concatenate(image.transform)
    draw(image.pixels, in: image.pixels.frame)
    restoreGState()
  }
}

/// What a context is told when it is created; none has an effect.
public struct CIContextOption: RawRepresentable, Hashable, Sendable {
  /// The name of the option.
  public let rawValue: String

  /// Creates an option from its name.
  public init(rawValue: String) { self.rawValue = rawValue }

  /// Whether intermediate images are kept.
  public static let cacheIntermediates = CIContextOption(rawValue: "cacheIntermediates")
  /// Whether the processor renders; it always does.
  public static let useSoftwareRenderer = CIContextOption(rawValue: "useSoftwareRenderer")
  /// The space that colours are computed in.
  public static let workingColorSpace = CIContextOption(rawValue: "workingColorSpace")
  /// The space of what is rendered.
  public static let outputColorSpace = CIContextOption(rawValue: "outputColorSpace")
}

/// What a context is told when it makes a file.
public struct CIImageRepresentationOption: RawRepresentable, Hashable, Sendable {
  /// The name of the option.
  public let rawValue: String

  /// Creates an option from its name.
  public init(rawValue: String) { self.rawValue = rawValue }
}

/// How pixels are stored.
public struct CIFormat: Hashable, Sendable {
  /// Red, green, blue and opacity, 8 bits each.
  public static let RGBA8 = CIFormat()
  /// Blue, green, red and opacity, 8 bits each.
  public static let BGRA8 = CIFormat()
}

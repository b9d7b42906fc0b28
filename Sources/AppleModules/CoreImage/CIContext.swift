import BitmapGraphics
import CoreVideo
import ImageIO
import Metal

/// Renders images on the CPU. Options have no effect, and colors are not converted.
public final class CIContext: Sendable {
  /// Creates a context.
  public init(options: [CIContextOption: Any]? = nil) {}

  /// Creates a context that renders with a device; it renders on the CPU in any case.
  public init(mtlDevice device: any MTLDevice, options: [CIContextOption: Any]? = nil) {}

  /// Renders an image into a buffer in an RGB format or `OneComponent8`, with the origin at the
  /// bottom left corner; buffers in other formats are not changed.
  public func render(_ image: CIImage, to buffer: CVPixelBuffer) {
    let size = CGSize(width: CVPixelBufferGetWidth(buffer), height: CVPixelBufferGetHeight(buffer))
    render(image, to: buffer, bounds: CGRect(origin: .zero, size: size), colorSpace: nil)
  }

  /// Renders the part of an image inside a rectangle into a buffer.
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

  /// Renders the part of an image inside a rectangle; nil if that is empty or too large.
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

  /// The image as JPEG data; nil if it can't be rendered.
  public func jpegRepresentation(
    of image: CIImage, colorSpace: CGColorSpace, options: [CIImageRepresentationOption: Any] = [:]
  ) -> Data? { file(of: image, "public.jpeg", quality(options)) }

  /// The image as PNG data; nil if it can't be rendered.
  public func pngRepresentation(
    of image: CIImage, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) -> Data? { file(of: image, "public.png", [:]) }

  /// Writes an image as a JPEG file. Throws a `CocoaError` if it can't be rendered or written.
  public func writeJPEGRepresentation(
    of image: CIImage, to url: URL, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) throws {
    try write(
      jpegRepresentation(of: image, colorSpace: colorSpace, options: options), to: url)
  }

  /// Writes an image as a PNG file. Throws a `CocoaError` if it can't be rendered or written.
  public func writePNGRepresentation(
    of image: CIImage, to url: URL, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) throws {
    try write(file(of: image, "public.png", [:]), to: url)
  }

  /// The image as HEIC data with the quality in `options`; nil if it can't be rendered.
  public func heifRepresentation(
    of image: CIImage, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) -> Data? { file(of: image, "public.heic", quality(options)) }

  /// Writes an image as a HEIC file. Throws a `CocoaError` if it can't be rendered or written.
  public func writeHEIFRepresentation(
    of image: CIImage, to url: URL, format: CIFormat, colorSpace: CGColorSpace,
    options: [CIImageRepresentationOption: Any] = [:]
  ) throws {
    try write(
      heifRepresentation(of: image, format: format, colorSpace: colorSpace, options: options),
      to: url)
  }

  /// The compression quality, the only option that the file formats support.
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

  /// The color space and bitmap info of a pixel format; nil for formats that can't be drawn into.
  private func layout(_ format: OSType) -> (CGColorSpace, UInt32)? {
    let rgb = CGColorSpaceCreateDeviceRGB()
    let first = CGImageAlphaInfo.premultipliedFirst.rawValue
    return switch format {
    case kCVPixelFormatType_32BGRA: (rgb, first | CGBitmapInfo.byteOrder32Little.rawValue)
    case kCVPixelFormatType_32ARGB: (rgb, first | CGBitmapInfo.byteOrder32Big.rawValue)
    case kCVPixelFormatType_32RGBA: (rgb, CGImageAlphaInfo.premultipliedLast.rawValue)
    case kCVPixelFormatType_OneComponent8:
      (CGColorSpaceCreateDeviceGray(), CGImageAlphaInfo.none.rawValue)
    default: nil
    }
  }
}

extension CGContext {
  /// Draws the visible part of an image; `origin` is placed at the bottom left corner.
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

/// Options of a context; none has an effect.
public struct CIContextOption: RawRepresentable, Hashable, Sendable {
  /// The name of the option.
  public let rawValue: String

  /// Creates an option from its name.
  public init(rawValue: String) { self.rawValue = rawValue }

  /// Whether intermediate images are cached.
  public static let cacheIntermediates = CIContextOption(rawValue: "cacheIntermediates")
  /// Whether to render on the CPU, which is always the case.
  public static let useSoftwareRenderer = CIContextOption(rawValue: "useSoftwareRenderer")
  /// The color space in which colors are computed.
  public static let workingColorSpace = CIContextOption(rawValue: "workingColorSpace")
  /// The color space of the rendered image.
  public static let outputColorSpace = CIContextOption(rawValue: "outputColorSpace")
}

/// Options of a context that writes a file.
public struct CIImageRepresentationOption: RawRepresentable, Hashable, Sendable {
  /// The name of the option.
  public let rawValue: String

  /// Creates an option from its name.
  public init(rawValue: String) { self.rawValue = rawValue }
}

/// A pixel format; has no effect here, since files have 8 bits per component, and all are equal.
public struct CIFormat: Hashable, Sendable {
  /// Red, green, blue and alpha, 8 bits each.
  public static let RGBA8 = CIFormat()
  /// Blue, green, red and alpha, 8 bits each.
  public static let BGRA8 = CIFormat()
}

/// An image in memory with one plane. On macOS a buffer may have several planes and attachments.
public final class CVPixelBuffer {
  /// The width in pixels.
  package let width: Int
  /// The height in pixels.
  package let height: Int
  /// The pixel format code, `kCVPixelFormatType_…`.
  package let pixelFormat: OSType
  /// The row stride in bytes, a multiple of 64.
  package let bytesPerRow: Int
  /// The memory of the pixels, top row first.
  package let storage: PixelStorage
  /// The bytes of a row without its padding.
  let rowSize: Int

  /// Fails for sides outside 1…65536 (at most 16 GiB) and for unsupported pixel formats.
  package init?(width: Int, height: Int, pixelFormat: OSType) {
    guard let pixelSize = bytesPerPixel(of: pixelFormat) else { return nil }
    guard (1...65536).contains(width), (1...65536).contains(height) else { return nil }
    self.width = width
    self.height = height
    self.pixelFormat = pixelFormat
    rowSize = width * pixelSize
    // Rows are aligned to 64 bytes, as on macOS.
    bytesPerRow = (rowSize + 63) / 64 * 64
    storage = PixelStorage(byteCount: bytesPerRow * height)
  }
}

extension CVPixelBuffer: Hashable {
  /// Whether both are the same buffer.
  public static func == (lhs: CVPixelBuffer, rhs: CVPixelBuffer) -> Bool { lhs === rhs }

  /// Hashes the identity of the buffer.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}

/// An image buffer; always a pixel buffer here.
public typealias CVImageBuffer = CVPixelBuffer
/// A buffer of any kind; always a pixel buffer here.
public typealias CVBuffer = CVPixelBuffer

/// The number of bytes per pixel; nil for formats that are not supported.
func bytesPerPixel(of format: OSType) -> Int? {
  switch format {
  case kCVPixelFormatType_32BGRA, kCVPixelFormatType_32ARGB, kCVPixelFormatType_32RGBA: 4
  case kCVPixelFormatType_DepthFloat32, kCVPixelFormatType_DisparityFloat32: 4
  case kCVPixelFormatType_DepthFloat16, kCVPixelFormatType_DisparityFloat16: 2
  case kCVPixelFormatType_OneComponent32Float: 4
  case kCVPixelFormatType_24RGB: 3
  case kCVPixelFormatType_OneComponent16Half: 2
  case kCVPixelFormatType_OneComponent8: 1
  default: nil
  }
}

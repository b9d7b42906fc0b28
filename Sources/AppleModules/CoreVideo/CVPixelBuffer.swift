import Kernels

/// An image in memory: what CoreVideo calls a pixel buffer, with one plane.
public final class CVPixelBuffer {
  package let width: Int
  package let height: Int
  package let pixelFormat: OSType
  package let bytesPerRow: Int
  package let storage: PixelStorage
  /// The bytes of a row that hold pixels.
  let rowSize: Int

  /// Fails for sizes below 1, images beyond 16 GiB and pixel formats without a fixed pixel size.
  package init?(width: Int, height: Int, pixelFormat: OSType) {
    guard let pixelSize = bytesPerPixel(of: pixelFormat) else { return nil }
    guard (1...65536).contains(width), (1...65536).contains(height) else { return nil }
    self.width = width
    self.height = height
    self.pixelFormat = pixelFormat
    rowSize = width * pixelSize
    // Rows begin at multiples of 64 bytes, as they do in CoreVideo.
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

/// An image that can be a pixel buffer; here it always is.
public typealias CVImageBuffer = CVPixelBuffer
/// A buffer of any kind; here it always has pixels.
public typealias CVBuffer = CVPixelBuffer

/// A code of four characters.
public typealias OSType = UInt32
/// How a CoreVideo function ended: 0 for success.
public typealias CVReturn = Int32

private func bytesPerPixel(of format: OSType) -> Int? {
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

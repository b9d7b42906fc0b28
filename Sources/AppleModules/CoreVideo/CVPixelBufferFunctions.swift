// swift-format-ignore-file: AlwaysUseLowerCamelCase
import Foundation

// The part of CoreVideo's C interface that fills and reads the pixel buffers of samples, with
// unsafe pointers where Apple's signatures have them.

/// Options for locking a buffer.
public struct CVPixelBufferLockFlags: OptionSet, Sendable {
  /// The bits of the flags.
  public let rawValue: UInt64

  /// Creates flags from their bits.
  public init(rawValue: UInt64) { self.rawValue = rawValue }

  /// The caller does not modify the pixels.
  public static let readOnly = CVPixelBufferLockFlags(rawValue: 1)
}

/// Creates a zero-filled pixel buffer. Allocator and attributes have no effect.
@discardableResult public func CVPixelBufferCreate(
  _ allocator: CFAllocator?, _ width: Int, _ height: Int, _ pixelFormatType: OSType,
  _ pixelBufferAttributes: CFDictionary?, _ pixelBufferOut: inout CVPixelBuffer?
) -> CVReturn {
  pixelBufferOut = CVPixelBuffer(width: width, height: height, pixelFormat: pixelFormatType)
  return pixelBufferOut == nil ? failure(pixelFormatType) : kCVReturnSuccess
}

/// Why there is no buffer of a format: the format, or else the size.
func failure(_ pixelFormat: OSType) -> CVReturn {
  bytesPerPixel(of: pixelFormat) == nil ? kCVReturnInvalidPixelFormat : kCVReturnInvalidArgument
}

/// Called when the bytes that a buffer was created with are no longer needed.
public typealias CVPixelBufferReleaseBytesCallback =
  @convention(c) (UnsafeMutableRawPointer?, UnsafeRawPointer?) -> Void

/// Creates a pixel buffer from rows of pixels. They are copied, so the callback, which gets
/// `releaseRefCon` and the bytes, is called before the function returns. Allocator and attributes
/// have no effect.
@discardableResult public func CVPixelBufferCreateWithBytes(
  _ allocator: CFAllocator?, _ width: Int, _ height: Int, _ pixelFormatType: OSType,
  _ baseAddress: UnsafeMutableRawPointer, _ bytesPerRow: Int,
  _ releaseCallback: CVPixelBufferReleaseBytesCallback?,
  _ releaseRefCon: UnsafeMutableRawPointer?, _ pixelBufferAttributes: CFDictionary?,
  _ pixelBufferOut: inout CVPixelBuffer?
) -> CVReturn {
  pixelBufferOut = CVPixelBuffer(width: width, height: height, pixelFormat: pixelFormatType)
  guard let buffer = pixelBufferOut, bytesPerRow >= buffer.rowSize else {
    pixelBufferOut = nil
    return failure(pixelFormatType)
  }
  let source = UnsafeRawBufferPointer(start: baseAddress, count: height * bytesPerRow)
  for row in 0..<height {
    let start = row * bytesPerRow
    buffer.storage.write(
      Array(source[start..<start + buffer.rowSize]), at: row * buffer.bytesPerRow)
  }
  releaseCallback?(releaseRefCon, baseAddress)
  return kCVReturnSuccess
}

/// Makes the pixels accessible; has no effect, they always are.
@discardableResult public func CVPixelBufferLockBaseAddress(
  _ pixelBuffer: CVPixelBuffer, _ lockFlags: CVPixelBufferLockFlags
) -> CVReturn { kCVReturnSuccess }

/// Ends the access to the pixels; has no effect.
@discardableResult public func CVPixelBufferUnlockBaseAddress(
  _ pixelBuffer: CVPixelBuffer, _ unlockFlags: CVPixelBufferLockFlags
) -> CVReturn { kCVReturnSuccess }

/// The address of the first row; valid as long as the buffer exists.
public func CVPixelBufferGetBaseAddress(
  _ pixelBuffer: CVPixelBuffer
) -> UnsafeMutableRawPointer? { pixelBuffer.storage.baseAddress }

/// The row stride in bytes.
public func CVPixelBufferGetBytesPerRow(_ pixelBuffer: CVPixelBuffer) -> Int {
  pixelBuffer.bytesPerRow
}

/// The width in pixels.
public func CVPixelBufferGetWidth(_ pixelBuffer: CVPixelBuffer) -> Int { pixelBuffer.width }

/// The height in pixels.
public func CVPixelBufferGetHeight(_ pixelBuffer: CVPixelBuffer) -> Int { pixelBuffer.height }

/// The pixel format code.
public func CVPixelBufferGetPixelFormatType(_ pixelBuffer: CVPixelBuffer) -> OSType {
  pixelBuffer.pixelFormat
}

/// The size of all rows in bytes, with padding.
public func CVPixelBufferGetDataSize(_ pixelBuffer: CVPixelBuffer) -> Int {
  pixelBuffer.storage.byteCount
}

/// Whether the buffer has several planes: always false.
public func CVPixelBufferIsPlanar(_ pixelBuffer: CVPixelBuffer) -> Bool { false }

/// The number of planes: 0 for a non-planar buffer.
public func CVPixelBufferGetPlaneCount(_ pixelBuffer: CVPixelBuffer) -> Int { 0 }

/// The address of a plane: nil, since buffers are not planar.
public func CVPixelBufferGetBaseAddressOfPlane(
  _ pixelBuffer: CVPixelBuffer, _ planeIndex: Int
) -> UnsafeMutableRawPointer? { nil }

/// The row stride of a plane in bytes: 0, since buffers are not planar.
public func CVPixelBufferGetBytesPerRowOfPlane(
  _ pixelBuffer: CVPixelBuffer, _ planeIndex: Int
) -> Int { 0 }

/// The width of a plane in pixels: 0, since buffers are not planar.
public func CVPixelBufferGetWidthOfPlane(_ pixelBuffer: CVPixelBuffer, _ planeIndex: Int) -> Int {
  0
}

/// The height of a plane in pixels: 0, since buffers are not planar.
public func CVPixelBufferGetHeightOfPlane(_ pixelBuffer: CVPixelBuffer, _ planeIndex: Int) -> Int {
  0
}

/// The width and height in pixels.
public func CVImageBufferGetEncodedSize(_ imageBuffer: CVImageBuffer) -> CGSize {
  CGSize(width: imageBuffer.width, height: imageBuffer.height)
}

/// The width and height at which to display the image, in pixels.
public func CVImageBufferGetDisplaySize(_ imageBuffer: CVImageBuffer) -> CGSize {
  CVImageBufferGetEncodedSize(imageBuffer)
}

/// Fills memory with a byte. As in the macOS C library, the address may be nil.
@discardableResult public func memset(
  _ address: UnsafeMutableRawPointer?, _ byte: Int32, _ count: Int
) -> UnsafeMutableRawPointer? { address.map { Foundation.memset($0, byte, count) } }

/// Copies memory. As in the macOS C library, the addresses may be nil.
@discardableResult public func memcpy(
  _ target: UnsafeMutableRawPointer?, _ source: UnsafeRawPointer?, _ count: Int
) -> UnsafeMutableRawPointer? {
  guard let target, let source else { return target }
  return Foundation.memcpy(target, source, count)
}

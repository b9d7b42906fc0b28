// swift-format-ignore-file: AlwaysUseLowerCamelCase
import Foundation
import Kernels

// The part of CoreVideo's C interface that fills and reads the pixel buffers of samples. Its
// signatures and those of CoreGraphics are the only ones outside of Kernels that name unsafe
// pointers.

/// How a buffer is locked.
public struct CVPixelBufferLockFlags: OptionSet, Sendable {
  /// The bits of the flags.
  public let rawValue: UInt64

  /// Creates flags from their bits.
  public init(rawValue: UInt64) { self.rawValue = rawValue }

  /// The pixels will not be changed.
  public static let readOnly = CVPixelBufferLockFlags(rawValue: 1)
}

/// Creates a pixel buffer of zeros. Allocator and attributes have no effect.
@discardableResult public func CVPixelBufferCreate(
  _ allocator: CFAllocator?, _ width: Int, _ height: Int, _ pixelFormatType: OSType,
  _ pixelBufferAttributes: CFDictionary?, _ pixelBufferOut: inout CVPixelBuffer?
) -> CVReturn {
  pixelBufferOut = CVPixelBuffer(width: width, height: height, pixelFormat: pixelFormatType)
  return pixelBufferOut == nil ? kCVReturnInvalidArgument : kCVReturnSuccess
}

/// Is told when the bytes that it was created with are not needed any more.
public typealias CVPixelBufferReleaseBytesCallback =
  @convention(c) (UnsafeMutableRawPointer?, UnsafeRawPointer?) -> Void

/// Creates a pixel buffer from rows of pixels, which are copied; so the callback, which gets
/// `releaseRefCon` and the bytes, is called at once. Allocator and attributes have no effect.
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
    return kCVReturnInvalidArgument
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

/// Makes the pixels accessible. They always are.
@discardableResult public func CVPixelBufferLockBaseAddress(
  _ pixelBuffer: CVPixelBuffer, _ lockFlags: CVPixelBufferLockFlags
) -> CVReturn { kCVReturnSuccess }

/// Ends the access to the pixels.
@discardableResult public func CVPixelBufferUnlockBaseAddress(
  _ pixelBuffer: CVPixelBuffer, _ unlockFlags: CVPixelBufferLockFlags
) -> CVReturn { kCVReturnSuccess }

/// The address of the first row; valid for as long as the buffer lives.
public func CVPixelBufferGetBaseAddress(
  _ pixelBuffer: CVPixelBuffer
) -> UnsafeMutableRawPointer? { pixelBuffer.storage.baseAddress }

/// The distance of two rows in bytes.
public func CVPixelBufferGetBytesPerRow(_ pixelBuffer: CVPixelBuffer) -> Int {
  pixelBuffer.bytesPerRow
}

/// The width in pixels.
public func CVPixelBufferGetWidth(_ pixelBuffer: CVPixelBuffer) -> Int { pixelBuffer.width }

/// The height in pixels.
public func CVPixelBufferGetHeight(_ pixelBuffer: CVPixelBuffer) -> Int { pixelBuffer.height }

/// The code of the pixel format.
public func CVPixelBufferGetPixelFormatType(_ pixelBuffer: CVPixelBuffer) -> OSType {
  pixelBuffer.pixelFormat
}

/// The number of bytes of all rows.
public func CVPixelBufferGetDataSize(_ pixelBuffer: CVPixelBuffer) -> Int {
  pixelBuffer.storage.byteCount
}

/// Whether the components lie in planes of their own; they never do.
public func CVPixelBufferIsPlanar(_ pixelBuffer: CVPixelBuffer) -> Bool { false }

/// The number of planes: 0 where the components don't lie in planes of their own.
public func CVPixelBufferGetPlaneCount(_ pixelBuffer: CVPixelBuffer) -> Int { 0 }

/// The address of a plane: nil, since buffers have no planes.
public func CVPixelBufferGetBaseAddressOfPlane(
  _ pixelBuffer: CVPixelBuffer, _ planeIndex: Int
) -> UnsafeMutableRawPointer? { nil }

/// The bytes from one row of a plane to the next: 0, since buffers have no planes.
public func CVPixelBufferGetBytesPerRowOfPlane(
  _ pixelBuffer: CVPixelBuffer, _ planeIndex: Int
) -> Int { 0 }

/// The width of a plane in pixels: 0, since buffers have no planes.
public func CVPixelBufferGetWidthOfPlane(_ pixelBuffer: CVPixelBuffer, _ planeIndex: Int) -> Int {
  0
}

/// The height of a plane in pixels: 0, since buffers have no planes.
public func CVPixelBufferGetHeightOfPlane(_ pixelBuffer: CVPixelBuffer, _ planeIndex: Int) -> Int {
  0
}

/// The width and height in pixels.
public func CVImageBufferGetEncodedSize(_ imageBuffer: CVImageBuffer) -> CGSize {
  CGSize(width: imageBuffer.width, height: imageBuffer.height)
}

/// The width and height in pixels, as an image is shown.
public func CVImageBufferGetDisplaySize(_ imageBuffer: CVImageBuffer) -> CGSize {
  CVImageBufferGetEncodedSize(imageBuffer)
}

/// Fills memory with a byte. The Mac's C library takes addresses that may be missing.
@discardableResult public func memset(
  _ address: UnsafeMutableRawPointer?, _ byte: Int32, _ count: Int
) -> UnsafeMutableRawPointer? { address.map { Foundation.memset($0, byte, count) } }

/// Copies memory. The Mac's C library takes addresses that may be missing.
@discardableResult public func memcpy(
  _ target: UnsafeMutableRawPointer?, _ source: UnsafeRawPointer?, _ count: Int
) -> UnsafeMutableRawPointer? {
  guard let target, let source else { return target }
  return Foundation.memcpy(target, source, count)
}

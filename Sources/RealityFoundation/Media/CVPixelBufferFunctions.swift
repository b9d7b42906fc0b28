// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The part of CoreVideo's C interface that fills and reads the pixel buffers of samples. Its
// signatures are the only ones outside of Kernels that name unsafe pointers.

/// The call succeeded.
public let kCVReturnSuccess: CVReturn = 0
/// A parameter of the call is not valid.
public let kCVReturnInvalidArgument: CVReturn = -6661
/// The pixel format is not supported.
public let kCVReturnInvalidPixelFormat: CVReturn = -6680

/// Blue, green, red, alpha; 8 bits each.
public let kCVPixelFormatType_32BGRA: OSType = 0x4247_5241
/// Alpha, red, green, blue; 8 bits each.
public let kCVPixelFormatType_32ARGB: OSType = 0x0000_0020
/// Red, green, blue, alpha; 8 bits each.
public let kCVPixelFormatType_32RGBA: OSType = 0x5247_4241
/// Red, green, blue; 8 bits each.
public let kCVPixelFormatType_24RGB: OSType = 0x0000_0018
/// One 8-bit component.
public let kCVPixelFormatType_OneComponent8: OSType = 0x4C30_3038
/// One 32-bit floating-point component.
public let kCVPixelFormatType_OneComponent32Float: OSType = 0x4C30_3066
/// Depths in metres as 32-bit floating-point numbers.
public let kCVPixelFormatType_DepthFloat32: OSType = 0x6664_6570
/// Disparities in 1/metre as 32-bit floating-point numbers.
public let kCVPixelFormatType_DisparityFloat32: OSType = 0x6664_6973

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
  _ allocator: AnyObject?, _ width: Int, _ height: Int, _ pixelFormatType: OSType,
  _ pixelBufferAttributes: [String: Any]?, _ pixelBufferOut: inout CVPixelBuffer?
) -> CVReturn {
  pixelBufferOut = CVPixelBuffer(width: width, height: height, pixelFormat: pixelFormatType)
  return pixelBufferOut == nil ? kCVReturnInvalidArgument : kCVReturnSuccess
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

/// The default allocator, which has no effect.
public var kCFAllocatorDefault: AnyObject? { nil }

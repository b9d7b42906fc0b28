// swift-format-ignore-file: AlwaysUseLowerCamelCase

@_exported import CoreFoundationTypes

/// A four-character code.
public typealias OSType = UInt32
/// The result code of a CoreVideo function: 0 means success.
public typealias CVReturn = Int32

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
/// Depths in meters as 32-bit floating-point numbers.
public let kCVPixelFormatType_DepthFloat32: OSType = 0x6664_6570
/// Disparities in 1/meter as 32-bit floating-point numbers.
public let kCVPixelFormatType_DisparityFloat32: OSType = 0x6664_6973
/// Depths in meters as 16-bit floating-point numbers.
public let kCVPixelFormatType_DepthFloat16: OSType = 0x6864_6570
/// Disparities in 1/meter as 16-bit floating-point numbers.
public let kCVPixelFormatType_DisparityFloat16: OSType = 0x6864_6973
/// One 16-bit floating-point component.
public let kCVPixelFormatType_OneComponent16Half: OSType = 0x4C30_3068
/// Alpha, blue, green, red; 8 bits each. Buffers of this format can't be created.
public let kCVPixelFormatType_32ABGR: OSType = 0x4142_4752
/// Luma and chroma in two planes, video range. Buffers of this format can't be created.
public let kCVPixelFormatType_420YpCbCr8BiPlanarVideoRange: OSType = 0x3432_3076
/// Luma and chroma in two planes, full range. Buffers of this format can't be created.
public let kCVPixelFormatType_420YpCbCr8BiPlanarFullRange: OSType = 0x3432_3066

/// Attribute: the pixel format code. Pools read it; elsewhere attributes have no effect.
public let kCVPixelBufferPixelFormatTypeKey: CFString = "PixelFormatType"
/// Attribute: the width in pixels.
public let kCVPixelBufferWidthKey: CFString = "Width"
/// Attribute: the height in pixels.
public let kCVPixelBufferHeightKey: CFString = "Height"
/// Attribute: the alignment of rows in bytes.
public let kCVPixelBufferBytesPerRowAlignmentKey: CFString = "BytesPerRowAlignment"
/// Attribute: whether Core Graphics can read the pixels.
public let kCVPixelBufferCGImageCompatibilityKey: CFString = "CGImageCompatibility"
/// Attribute: whether Core Graphics can draw into the pixels.
public let kCVPixelBufferCGBitmapContextCompatibilityKey: CFString = "CGBitmapContextCompatibility"
/// Attribute: whether Metal can read the pixels.
public let kCVPixelBufferMetalCompatibilityKey: CFString = "MetalCompatibility"
/// Attribute: how the pixels are shared between processes.
public let kCVPixelBufferIOSurfacePropertiesKey: CFString = "IOSurfaceProperties"
/// Pool attribute: the minimum number of buffers to keep.
public let kCVPixelBufferPoolMinimumBufferCountKey: CFString = "MinimumBufferCount"
/// Pool attribute: the maximum age of an unused buffer in seconds.
public let kCVPixelBufferPoolMaximumBufferAgeKey: CFString = "MaximumBufferAge"

// swift-format-ignore-file: AlwaysUseLowerCamelCase

/// Creates buffers of one size and format. Nothing is pooled: each buffer is new, and the memory of
/// released ones is soon reused by the system.
public final class CVPixelBufferPool: Sendable {
  fileprivate let width: Int
  fileprivate let height: Int
  fileprivate let format: OSType

  fileprivate init?(_ attributes: CFDictionary) {
    func number(_ key: CFString) -> Int? { (attributes[key] as? NSNumber)?.intValue }
    let formats = attributes[kCVPixelBufferPixelFormatTypeKey] as? [NSNumber]
    guard let width = number(kCVPixelBufferWidthKey), let height = number(kCVPixelBufferHeightKey),
      let format = number(kCVPixelBufferPixelFormatTypeKey) ?? formats?.first?.intValue,
      let code = OSType(exactly: format)
    else { return nil }
    (self.width, self.height, self.format) = (width, height, code)
  }

  fileprivate func makeBuffer() -> CVPixelBuffer? {
    CVPixelBuffer(width: width, height: height, pixelFormat: format)
  }
}

/// Creates a pool. `pixelBufferAttributes` must contain width, height and pixel format;
/// `poolAttributes` has no effect.
@discardableResult public func CVPixelBufferPoolCreate(
  _ allocator: CFAllocator?, _ poolAttributes: CFDictionary?,
  _ pixelBufferAttributes: CFDictionary?, _ poolOut: inout CVPixelBufferPool?
) -> CVReturn {
  poolOut = pixelBufferAttributes.flatMap { CVPixelBufferPool($0) }
  return poolOut == nil ? kCVReturnInvalidArgument : kCVReturnSuccess
}

/// Creates a buffer.
@discardableResult public func CVPixelBufferPoolCreatePixelBuffer(
  _ allocator: CFAllocator?, _ pixelBufferPool: CVPixelBufferPool,
  _ pixelBufferOut: inout CVPixelBuffer?
) -> CVReturn {
  pixelBufferOut = pixelBufferPool.makeBuffer()
  return pixelBufferOut == nil ? failure(pixelBufferPool.format) : kCVReturnSuccess
}

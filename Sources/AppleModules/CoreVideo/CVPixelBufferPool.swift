// swift-format-ignore-file: AlwaysUseLowerCamelCase

/// Makes buffers of one size and format. Each is a new one: memory that is given back is soon used
/// again.
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

/// Creates a pool. The attributes of its buffers have to name the width, the height and the format;
/// those of the pool have no effect.
@discardableResult public func CVPixelBufferPoolCreate(
  _ allocator: CFAllocator?, _ poolAttributes: CFDictionary?,
  _ pixelBufferAttributes: CFDictionary?, _ poolOut: inout CVPixelBufferPool?
) -> CVReturn {
  poolOut = pixelBufferAttributes.flatMap { CVPixelBufferPool($0) }
  return poolOut == nil ? kCVReturnInvalidArgument : kCVReturnSuccess
}

/// Makes a buffer.
@discardableResult public func CVPixelBufferPoolCreatePixelBuffer(
  _ allocator: CFAllocator?, _ pixelBufferPool: CVPixelBufferPool,
  _ pixelBufferOut: inout CVPixelBuffer?
) -> CVReturn {
  pixelBufferOut = pixelBufferPool.makeBuffer()
  return pixelBufferOut == nil ? kCVReturnInvalidArgument : kCVReturnSuccess
}

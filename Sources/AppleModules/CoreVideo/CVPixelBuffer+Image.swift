import SceneModel

extension CVPixelBuffer {
  /// The pixels as RGB without alpha; nil for formats without three color components.
  package var image: RasterImage? {
    let (size, offsets): (Int, [Int])
    switch pixelFormat {
    case kCVPixelFormatType_32BGRA: (size, offsets) = (4, [2, 1, 0])
    case kCVPixelFormatType_32ARGB: (size, offsets) = (4, [1, 2, 3])
    case kCVPixelFormatType_32RGBA: (size, offsets) = (4, [0, 1, 2])
    case kCVPixelFormatType_24RGB: (size, offsets) = (3, [0, 1, 2])
    default: return nil
    }
    var pixels: [UInt8] = []
    pixels.reserveCapacity(width * height * 3)
    for row in 0..<height {
      let bytes = storage.copy(row * bytesPerRow..<row * bytesPerRow + width * size)
      for start in stride(from: 0, to: bytes.count, by: size) {
        for offset in offsets { pixels.append(bytes[start + offset]) }
      }
    }
    return RasterImage(width: width, height: height, channels: 3, pixels: pixels)
  }

  /// The pixels as gray; nil for formats other than OneComponent8.
  package var grayImage: RasterImage? {
    guard pixelFormat == kCVPixelFormatType_OneComponent8 else { return nil }
    var pixels: [UInt8] = []
    pixels.reserveCapacity(width * height)
    for row in 0..<height {
      pixels += storage.copy(row * bytesPerRow..<row * bytesPerRow + width)
    }
    return RasterImage(width: width, height: height, channels: 1, pixels: pixels)
  }

  /// Creates a 32BGRA buffer from an RGB image; nil unless it has 3 channels.
  package convenience init?(_ image: RasterImage) {
    guard image.channels == 3 else { return nil }
    self.init(width: image.width, height: image.height, pixelFormat: kCVPixelFormatType_32BGRA)
    for row in 0..<image.height {
      var bytes: [UInt8] = []
      bytes.reserveCapacity(image.width * 4)
      for pixel in row * image.width..<(row + 1) * image.width {
        for channel in [2, 1, 0] { bytes.append(image.pixels[3 * pixel + channel]) }
        bytes.append(255)
      }
      storage.write(bytes, at: row * bytesPerRow)
    }
  }
}

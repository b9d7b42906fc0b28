import SceneModel

/// An immutable image: gray or RGB, with or without alpha, 8 bits per component.
public final class CGImage: Sendable {
  /// 1 channel for gray, 3 for RGB, 4 for RGB with alpha that is not premultiplied.
  package let raster: RasterImage

  /// Creates an image from a raster with 1, 3 or 4 channels.
  package init(_ raster: RasterImage) { self.raster = raster }

  /// Creates an image from its pixels in memory.
  ///
  /// Fails for anything but 8 bits per component, and if the provider holds too few bytes.
  public convenience init?(
    width: Int, height: Int, bitsPerComponent: Int, bitsPerPixel: Int, bytesPerRow: Int,
    space: CGColorSpace, bitmapInfo: CGBitmapInfo, provider: CGDataProvider,
    decode: UnsafePointer<CGFloat>?, shouldInterpolate: Bool, intent: CGColorRenderingIntent
  ) {
    guard let layout = PixelLayout(space.model, bitmapInfo), bitsPerComponent == 8,
      bitsPerPixel == 8 * layout.size, (1...65536).contains(width), (1...65536).contains(height),
      bytesPerRow >= width * layout.size
    else { return nil }
    let bytes = [UInt8](provider.bytes)
    guard bytes.count >= (height - 1) * bytesPerRow + width * layout.size else { return nil }
    self.init(
      layout.raster(width: width, height: height) { row in
        bytes[row * bytesPerRow..<row * bytesPerRow + width * layout.size]
      })
  }

  /// The width in pixels.
  public var width: Int { raster.width }
  /// The height in pixels.
  public var height: Int { raster.height }
  /// The number of bits per component.
  public var bitsPerComponent: Int { 8 }
  /// The number of bits per pixel: 8 for gray, 32 for RGB.
  public var bitsPerPixel: Int { raster.channels == 1 ? 8 : 32 }
  /// The row stride in bytes.
  public var bytesPerRow: Int { width * bitsPerPixel / 8 }
  /// The color space of the pixels.
  public var colorSpace: CGColorSpace? {
    CGColorSpace(name: raster.channels == 1 ? CGColorSpace.genericGrayGamma2_2 : CGColorSpace.sRGB)
  }
  /// Where the alpha component is.
  public var alphaInfo: CGImageAlphaInfo {
    switch raster.channels {
    case 1: .none
    case 4: .last
    default: .noneSkipLast
    }
  }
  /// How the components are arranged in memory.
  public var bitmapInfo: CGBitmapInfo { CGBitmapInfo(rawValue: alphaInfo.rawValue) }

  /// The pixels in the memory layout of `bitmapInfo`.
  public var dataProvider: CGDataProvider? {
    guard raster.channels == 3 else { return CGDataProvider(Data(raster.pixels)) }
    var bytes = [UInt8](repeating: 255, count: width * height * 4)
    for pixel in 0..<width * height {
      for channel in 0..<3 { bytes[4 * pixel + channel] = raster.pixels[3 * pixel + channel] }
    }
    return CGDataProvider(Data(bytes))
  }

  /// The part of the image inside a rectangle, with y down from the top; nil if they don't
  /// intersect.
  public func cropping(to rect: CGRect) -> CGImage? {
    let part = rect.integral.intersection(CGRect(x: 0, y: 0, width: width, height: height))
    guard !part.isNull, part.width >= 1, part.height >= 1 else { return nil }
    let columns = Int(part.minX)..<Int(part.maxX)
    var pixels: [UInt8] = []
    pixels.reserveCapacity(columns.count * Int(part.height) * raster.channels)
    for row in Int(part.minY)..<Int(part.maxY) {
      let start = (row * width + columns.lowerBound) * raster.channels
      pixels += raster.pixels[start..<start + columns.count * raster.channels]
    }
    return CGImage(
      RasterImage(
        width: columns.count, height: Int(part.height), channels: raster.channels, pixels: pixels))
  }

  /// A copy that shares the pixels.
  public func copy() -> CGImage? { CGImage(raster) }
}

/// The bytes that an image is created from, or the bytes of an image.
public final class CGDataProvider: Sendable {
  let bytes: Data

  init(_ bytes: Data) { self.bytes = bytes }

  /// Creates a provider of bytes.
  public convenience init?(data: CFData) { self.init(data) }

  /// Creates a provider of a file's content; nil if it can't be read.
  public convenience init?(url: CFURL) {
    guard let bytes = try? Data(contentsOf: url) else { return nil }
    self.init(bytes)
  }

  /// The bytes.
  public var data: CFData? { bytes }
}

/// How out-of-gamut colors are mapped; has no effect.
public enum CGColorRenderingIntent: Int32, Hashable, Sendable {
  /// The default intent.
  case defaultIntent
  /// Keeps colors as they are.
  case absoluteColorimetric
  /// Relative to the white point.
  case relativeColorimetric
  /// Preserves the visual relation of colors.
  case perceptual
  /// Preserves saturation.
  case saturation
}

extension PixelLayout {
  /// The rows of a bitmap with this layout as an image.
  func raster(width: Int, height: Int, row: (Int) -> ArraySlice<UInt8>) -> RasterImage {
    let channels = colorOffsets.count < 3 ? 1 : alpha == nil ? 3 : 4
    var pixels: [UInt8] = []
    pixels.reserveCapacity(width * height * channels)
    for y in 0..<height {
      let bytes = row(y)
      for start in stride(from: bytes.startIndex, to: bytes.endIndex, by: size) {
        let opacity = alpha.map { bytes[start + $0] } ?? 255
        if colorOffsets.isEmpty { pixels.append(opacity) }
        for offset in colorOffsets {
          let value = bytes[start + offset]
          pixels.append(isPremultiplied ? divided(value, byAlpha: opacity) : value)
        }
        if channels == 4 { pixels.append(opacity) }
      }
    }
    return RasterImage(width: width, height: height, channels: channels, pixels: pixels)
  }
}

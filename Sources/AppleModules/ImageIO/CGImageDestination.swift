// swift-format-ignore-file: AlwaysUseLowerCamelCase
import CoreFoundationTypes
import ImageFiles
import SceneModel

/// Writes the pixels of an image to a file or into memory as JPEG, PNG or HEIC. Metadata is not
/// written.
public final class CGImageDestination {
  private let type: CFString
  private let write: (Data) throws -> Void
  private var image: (raster: RasterImage, quality: Float)?

  init?(_ type: CFString, _ count: Int, write: @escaping (Data) throws -> Void) {
    guard count == 1, ["public.jpeg", "public.png", "public.heic"].contains(type) else {
      return nil
    }
    self.type = type
    self.write = write
  }

  /// Adds the image; only the first one is written.
  func add(_ raster: RasterImage, _ options: CFDictionary?) {
    let quality = options?[kCGImageDestinationLossyCompressionQuality] as? NSNumber
    image = image ?? (raster, quality?.floatValue ?? 0.9)
  }

  /// Encodes and writes the image; returns whether that succeeded.
  func finalize() -> Bool {
    guard let image, let bytes = try? encoded(image.raster, image.quality) else { return false }
    return (try? write(Data(bytes))) != nil
  }

  private func encoded(_ raster: RasterImage, _ quality: Float) throws -> [UInt8] {
    if type == "public.png" { return try ImageCodec.encodePNG(raster) }
    if type == "public.jpeg" {
      // JPEG has no alpha.
      let image = raster.channels == 4 ? raster.withChannels([0, 1, 2]) : raster
      return try ImageCodec.encodeJPEG(image, quality: quality)
    }
    var content = ImageCodec.HEICContent()
    content.quality = quality
    let image = raster.channels == 1 ? raster.withChannels([0, 0, 0]) : raster
    return try ImageCodec.encodeHEIC(image, content)
  }
}

extension RasterImage {
  /// The image made of the given channels, in that order.
  fileprivate func withChannels(_ chosen: [Int]) -> RasterImage {
    var result = RasterImage(width: width, height: height, channels: chosen.count)
    for index in 0..<width * height {
      for (target, source) in chosen.enumerated() {
        result.pixels[chosen.count * index + target] = pixels[channels * index + source]
      }
    }
    return result
  }
}

/// Creates a destination for a file; nil unless the type is `public.jpeg`, `public.png` or
/// `public.heic` and the number of images is 1.
public func CGImageDestinationCreateWithURL(
  _ url: CFURL, _ type: CFString, _ count: Int, _ options: CFDictionary?
) -> CGImageDestination? { CGImageDestination(type, count) { try $0.write(to: url) } }

/// Creates a destination in memory; nil unless type and number of images are supported.
public func CGImageDestinationCreateWithData(
  _ data: CFMutableData, _ type: CFString, _ count: Int, _ options: CFDictionary?
) -> CGImageDestination? { CGImageDestination(type, count) { data.append($0) } }

/// Adds the image. `properties` may contain `kCGImageDestinationLossyCompressionQuality`.
public func CGImageDestinationAddImage(
  _ idst: CGImageDestination, _ image: CGImage, _ properties: CFDictionary?
) { idst.add(image.raster, properties) }

/// Adds the image of a source.
public func CGImageDestinationAddImageFromSource(
  _ idst: CGImageDestination, _ isrc: CGImageSource, _ index: Int, _ properties: CFDictionary?
) {
  guard index == 0, let image = isrc.image() else { return }
  idst.add(image, properties)
}

/// Writes the image; returns whether that succeeded.
public func CGImageDestinationFinalize(_ idst: CGImageDestination) -> Bool { idst.finalize() }

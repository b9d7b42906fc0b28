import Foundation
import ImageFiles
import ImageIO
import SceneModel
import TestSupport
import Testing

@Suite struct CGImageDestinationTests {
  private let photo = CGImage(RasterImage(width: 64, height: 48, channels: 3, filledWith: 120))

  /// What the destination writes; nil where it refuses to.
  private func written(
    _ image: CGImage, _ type: String, quality: Double? = nil
  ) throws -> [UInt8]? {
    let data = NSMutableData()
    let destination = try #require(CGImageDestinationCreateWithData(data, type, 1, nil))
    CGImageDestinationAddImage(
      destination, image, quality.map { [kCGImageDestinationLossyCompressionQuality: $0] })
    return CGImageDestinationFinalize(destination) ? [UInt8](data as Data) : nil
  }

  @Test(arguments: [1, 3, 4]) func pngFilesKeepEveryPixel(channels: Int) throws {
    let pixels = (0..<6 * channels).map { UInt8(10 * $0) }
    let raster = RasterImage(width: 3, height: 2, channels: channels, pixels: pixels)
    let bytes = try #require(try written(CGImage(raster), "public.png"))
    let source = try #require(CGImageSourceCreateWithData(Data(bytes), nil))
    #expect(CGImageSourceCreateImageAtIndex(source, 0, nil)?.raster == raster)
  }

  @Test(
    arguments: [
      ("public.jpeg", ImageHeader.Format.jpeg), ("public.png", .png), ("public.heic", .heic),
    ] as [(String, ImageHeader.Format)]) func filesHaveTheirType(
      type: String, format: ImageHeader.Format
    ) throws
  {
    let bytes = try #require(try written(photo, type))
    #expect(try ImageHeader(bytes) == ImageHeader(format: format, width: 64, height: 48))
  }

  @Test(arguments: ["public.jpeg", "public.heic"]) func qualityDeterminesTheSize(
    type: String
  ) throws {
    let noise = CGImage(TexturePattern.image(width: 64, height: 64, seed: 1))
    let low = try #require(try written(noise, type, quality: 0.2))
    let high = try #require(try written(noise, type, quality: 0.95))
    #expect(2 * low.count < high.count)
  }

  @Test func jpegFilesDropOpacity() throws {
    let raster = RasterImage(width: 16, height: 16, channels: 4, filledWith: 100)
    let bytes = try #require(try written(CGImage(raster), "public.jpeg", quality: 1))
    let decoded = try ImageCodec.decode(bytes)
    #expect(decoded.channels == 3 && decoded.pixels.allSatisfy { abs(Int($0) - 100) <= 1 })
  }

  @Test func grayImagesCanBeHEIC() throws {
    let raster = RasterImage(width: 64, height: 64, channels: 1, filledWith: 100)
    let bytes = try #require(try written(CGImage(raster), "public.heic", quality: 0.95))
    let decoded = try ImageCodec.decode(bytes)
    #expect(decoded.pixels.allSatisfy { abs(Int($0) - 100) <= 3 })
  }

  @Test func unsupportedDestinationsAreRefused() {
    let url = URL(fileURLWithPath: "/tmp/image")
    for type in ["public.tiff", "com.ilm.openexr-image", ""] {
      #expect(CGImageDestinationCreateWithData(NSMutableData(), type, 1, nil) == nil)
      #expect(CGImageDestinationCreateWithURL(url, type, 1, nil) == nil)
    }
    for count in [0, 2] {
      #expect(CGImageDestinationCreateWithURL(url, "public.png", count, nil) == nil)
    }
  }

  @Test func nothingIsWrittenWithoutAnImage() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("a.png")
    let destination = try #require(CGImageDestinationCreateWithURL(url, "public.png", 1, nil))
    #expect(!CGImageDestinationFinalize(destination))
    #expect(!FileManager.default.fileExists(atPath: url.path))
  }

  @Test func theFirstImageIsWritten() throws {
    let data = NSMutableData()
    let destination = try #require(CGImageDestinationCreateWithData(data, "public.png", 1, nil))
    CGImageDestinationAddImage(destination, photo, nil)
    CGImageDestinationAddImage(
      destination, CGImage(RasterImage(width: 1, height: 1, channels: 1)), nil)
    #expect(CGImageDestinationFinalize(destination))
    #expect(try ImageHeader([UInt8](data as Data)).width == 64)
  }

  @Test func imagesOfASourceAreCopied() throws {
    let folder = try TemporaryFolder()
    let raster = RasterImage(width: 2, height: 1, channels: 3, pixels: [1, 2, 3, 4, 5, 6])
    let url = try folder.write(try ImageCodec.encodePNG(raster), as: "a.png")
    let source = try #require(CGImageSourceCreateWithURL(url, nil))
    let target = folder.url.appendingPathComponent("b.png")
    let destination = try #require(CGImageDestinationCreateWithURL(target, "public.png", 1, nil))
    CGImageDestinationAddImageFromSource(destination, source, 1, nil)
    #expect(!CGImageDestinationFinalize(destination))
    CGImageDestinationAddImageFromSource(destination, source, 0, nil)
    #expect(CGImageDestinationFinalize(destination))
    #expect(try ImageCodec.decode([UInt8](Data(contentsOf: target))) == raster)
  }

  @Test func unwritableFilesAreReported() throws {
    let url = URL(fileURLWithPath: "/missing/folder/a.png")
    let destination = try #require(CGImageDestinationCreateWithURL(url, "public.png", 1, nil))
    CGImageDestinationAddImage(destination, photo, nil)
    #expect(!CGImageDestinationFinalize(destination))
  }
}

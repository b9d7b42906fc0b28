import BitmapGraphics
import CoreVideo
import Foundation
import ImageFiles
import ImageIO
import Metal
import SceneModel
import TestSupport
import Testing

@Suite struct CIContextTests {
  private let renderer = ImageRenderer()
  private let space = CGColorSpaceCreateDeviceRGB()
  /// Red and green above blue and a half transparent white.
  private let image = RenderedImage(
    cgImage: CGImage(
      RasterImage(
        width: 2, height: 2, channels: 4,
        pixels: [255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128])))

  private func buffer(
    _ width: Int, _ height: Int, _ format: OSType
  ) throws -> CVPixelBuffer {
    var buffer: CVPixelBuffer?
    CVPixelBufferCreate(nil, width, height, format, nil, &buffer)
    let result = try #require(buffer)
    // Rendering replaces what is there.
    memset(CVPixelBufferGetBaseAddress(result), 77, CVPixelBufferGetDataSize(result))
    return result
  }

  private func row(_ row: Int, of buffer: CVPixelBuffer, count: Int) throws -> [UInt8] {
    let base = try #require(CVPixelBufferGetBaseAddress(buffer))
    return Array(
      UnsafeRawBufferPointer(
        start: base + row * CVPixelBufferGetBytesPerRow(buffer), count: count))
  }

  @Test(
    arguments: [
      (kCVPixelFormatType_32BGRA, [0, 0, 255, 255, 0, 255, 0, 255]),
      (kCVPixelFormatType_32ARGB, [255, 255, 0, 0, 255, 0, 255, 0]),
      (kCVPixelFormatType_32RGBA, [255, 0, 0, 255, 0, 255, 0, 255]),
      (kCVPixelFormatType_OneComponent8, [76, 150]),
    ] as [(OSType, [UInt8])])
  func buffersReceiveTheirComponents(format: OSType, topRow: [UInt8]) throws {
    let buffer = try buffer(2, 2, format)
    renderer.render(image, to: buffer)
    #expect(try row(0, of: buffer, count: topRow.count) == topRow)
  }

  @Test func opacityIsPremultiplied() throws {
    let buffer = try buffer(2, 2, kCVPixelFormatType_32RGBA)
    renderer.render(image, to: buffer)
    #expect(try row(1, of: buffer, count: 8) == [0, 0, 255, 255, 128, 128, 128, 128])
  }

  @Test func largerBuffersAreClearOutside() throws {
    let buffer = try buffer(3, 3, kCVPixelFormatType_32RGBA)
    renderer.render(image, to: buffer)
    #expect(try row(0, of: buffer, count: 12) == [UInt8](repeating: 0, count: 12))
    #expect(
      try row(1, of: buffer, count: 12) == [255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 0, 0])
  }

  @Test func boundsSelectAPart() throws {
    let buffer = try buffer(1, 1, kCVPixelFormatType_32RGBA)
    renderer.render(
      image, to: buffer, bounds: CGRect(x: 1, y: 1, width: 1, height: 1), colorSpace: space)
    #expect(try row(0, of: buffer, count: 4) == [0, 255, 0, 255])
  }

  @Test func otherBuffersStayAsTheyAre() throws {
    let buffer = try buffer(2, 2, kCVPixelFormatType_DepthFloat32)
    renderer.render(image, to: buffer)
    #expect(try row(0, of: buffer, count: 8) == [UInt8](repeating: 77, count: 8))
  }

  @Test func scaledImagesAreRendered() throws {
    let scaled = image.transformed(by: CGAffineTransform(scaleX: 0.5, y: 0.5))
    let single = try #require(renderer.createCGImage(scaled, from: scaled.extent))
    #expect(single.width == 1 && single.height == 1)
    let enlarged = image.transformed(by: CGAffineTransform(scaleX: 3, y: 1))
    let wide = try #require(renderer.createCGImage(enlarged, from: enlarged.extent)).raster
    #expect(wide.width == 6 && Array(wide.pixels[0..<4]) == [255, 0, 0, 255])
  }

  @Test func emptyAndHugePartsAreRefused() {
    for rectangle in [
      CGRect.zero, .null, .infinite, CGRect(x: 0, y: 0, width: 70000, height: 1),
    ] { #expect(renderer.createCGImage(image, from: rectangle) == nil) }
  }

  @Test func pngFilesKeepEveryPixel() throws {
    let bytes = try #require(
      renderer.pngRepresentation(of: image, format: .RGBA8, colorSpace: space))
    let source = try #require(CGImageSourceCreateWithData(bytes, nil))
    #expect(CGImageSourceGetType(source) == "public.png")
    let read = try #require(CGImageSourceCreateImageAtIndex(source, 0, nil))
    #expect(read.raster == image.cgImage?.raster)
  }

  @Test func jpegFilesFollowTheQuality() throws {
    let photo = RenderedImage(
      cgImage: CGImage(TexturePattern.image(width: 64, height: 64, seed: 1)))
    func size(_ quality: Double) throws -> Int {
      let key = RepresentationOption(rawValue: kCGImageDestinationLossyCompressionQuality)
      let options = [key: quality as Any]
      return try #require(
        renderer.jpegRepresentation(of: photo, colorSpace: space, options: options)
      ).count
    }
    #expect(try 2 * size(0.2) < size(0.95))
  }

  @Test func filesOfEachTypeAreWritten() throws {
    let folder = try TemporaryFolder()
    let photo = RenderedImage(
      cgImage: CGImage(RasterImage(width: 64, height: 48, channels: 3, filledWith: 120)))
    let urls = ["a.jpg", "b.png", "c.heic"].map { folder.url.appendingPathComponent($0) }
    try renderer.writeJPEGRepresentation(of: photo, to: urls[0], colorSpace: space)
    try renderer.writePNGRepresentation(of: photo, to: urls[1], format: .BGRA8, colorSpace: space)
    try renderer.writeHEIFRepresentation(of: photo, to: urls[2], format: .RGBA8, colorSpace: space)
    let headers = try urls.map { try ImageHeader([UInt8](Data(contentsOf: $0))) }
    #expect(headers.map(\.format) == [.jpeg, .png, .heic])
    #expect(headers.allSatisfy { $0.width == 64 && $0.height == 48 })
  }

  @Test func unwritableFilesThrow() {
    let url = URL(fileURLWithPath: "/missing/folder/a.png")
    #expect(throws: CocoaError.self) {
      try renderer.writePNGRepresentation(of: image, to: url, format: .RGBA8, colorSpace: space)
    }
    let nothing = image.cropped(to: CGRect(x: 9, y: 9, width: 1, height: 1))
    #expect(renderer.pngRepresentation(of: nothing, format: .RGBA8, colorSpace: space) == nil)
    #expect(throws: CocoaError.self) {
      try renderer.writeJPEGRepresentation(of: nothing, to: url, colorSpace: space)
    }
  }

  @Test func aDeviceRendersTheSame() throws {
    let device = try #require(MTLCreateSystemDefaultDevice())
    let part = CGRect(x: 0, y: 0, width: 2, height: 2)
    let other = ImageRenderer(mtlDevice: device).createCGImage(image, from: part)
    #expect(try #require(other).raster == renderer.createCGImage(image, from: part)?.raster)
  }
}

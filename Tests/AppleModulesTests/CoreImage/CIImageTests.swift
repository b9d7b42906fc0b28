import BitmapGraphics
import CoreVideo
import Foundation
import ImageFiles
import ImageIO
import SceneModel
import TestSupport
import Testing

@Suite struct CIImageTests {
  /// 1 2 3 above 4 5 6.
  private let image = RenderedImage(
    cgImage: CGImage(RasterImage(width: 3, height: 2, channels: 1, pixels: [1, 2, 3, 4, 5, 6])))
  private let renderer = ImageRenderer()

  private func rows(_ image: RenderedImage) throws -> [[UInt8]] {
    let raster = try #require(renderer.createCGImage(image, from: image.extent)).raster
    try #require(raster.channels == 1)
    return (0..<raster.height).map { row in
      Array(raster.pixels[row * raster.width..<(row + 1) * raster.width])
    }
  }

  @Test(
    arguments: [
      (1, [[1, 2, 3], [4, 5, 6]]), (2, [[3, 2, 1], [6, 5, 4]]), (3, [[6, 5, 4], [3, 2, 1]]),
      (4, [[4, 5, 6], [1, 2, 3]]), (5, [[1, 4], [2, 5], [3, 6]]), (6, [[4, 1], [5, 2], [6, 3]]),
      (7, [[6, 3], [5, 2], [4, 1]]), (8, [[3, 6], [2, 5], [1, 4]]),
    ] as [(UInt32, [[UInt8]])]) func orientationsAreAppliedUpright(
      value: UInt32, expected: [[UInt8]]
    ) throws
  {
    let orientation = try #require(CGImagePropertyOrientation(rawValue: value))
    let moved = image.transformed(by: CGAffineTransform(translationX: 7, y: -9))
    for source in [image, moved] {
      let oriented = source.oriented(orientation)
      #expect(oriented.extent.origin == .zero)
      #expect(try rows(oriented) == expected)
      #expect(try rows(source.oriented(forExifOrientation: Int32(value))) == expected)
    }
  }

  @Test func unknownOrientationsChangeNothing() throws {
    for value in [0, 9, -1] as [Int32] {
      #expect(try rows(image.oriented(forExifOrientation: value)) == [[1, 2, 3], [4, 5, 6]])
    }
  }

  @Test func extentFollowsTransformsAndCrops() {
    #expect(image.extent == CGRect(x: 0, y: 0, width: 3, height: 2))
    let scaled = image.transformed(by: CGAffineTransform(scaleX: 2, y: 3))
    #expect(scaled.extent == CGRect(x: 0, y: 0, width: 6, height: 6))
    let cropped = scaled.cropped(to: CGRect(x: 1, y: 1, width: 90, height: 2))
    #expect(cropped.extent == CGRect(x: 1, y: 1, width: 5, height: 2))
    #expect(image.cropped(to: CGRect(x: 9, y: 9, width: 1, height: 1)).extent.isNull)
  }

  @Test func cropsCountFromTheBottom() throws {
    #expect(try rows(image.cropped(to: CGRect(x: 1, y: 0, width: 2, height: 1))) == [[5, 6]])
    #expect(try rows(image.cropped(to: CGRect(x: 0, y: 1, width: 1, height: 9))) == [[1]])
  }

  @Test func cropsStayWhereTheyAre() throws {
    let moved = image.cropped(to: CGRect(x: 2, y: 1, width: 1, height: 1))
      .transformed(by: CGAffineTransform(translationX: -2, y: 4))
    #expect(moved.extent == CGRect(x: 0, y: 5, width: 1, height: 1))
    #expect(try rows(moved) == [[3]])
  }

  @Test func onlyUnchangedImagesHaveAnImageOfTheirPixels() {
    #expect(image.cgImage?.raster.pixels == [1, 2, 3, 4, 5, 6])
    #expect(image.transformed(by: CGAffineTransform(translationX: 1, y: 0)).cgImage == nil)
    #expect(image.cropped(to: CGRect(x: 0, y: 0, width: 1, height: 1)).cgImage == nil)
  }

  @Test func filesAreTurnedUprightOnRequestOnly() throws {
    var fields = ExifFields()
    fields.orientation = 6
    let raster = RasterImage(width: 32, height: 16, channels: 3, filledWith: 90)
    let jpeg = ExifWriter.jpeg(try ImageCodec.encodeJPEG(raster, quality: 0.9), with: fields)
    let folder = try TemporaryFolder()
    let url = try folder.write(jpeg, as: "photo.jpg")
    let stored = try #require(RenderedImage(contentsOf: url))
    #expect(stored.extent == CGRect(x: 0, y: 0, width: 32, height: 16) && stored.url == url)
    #expect((stored.properties[kCGImagePropertyOrientation] as? NSNumber)?.intValue == 6)
    let upright = try #require(
      RenderedImage(data: Data(jpeg), options: [.applyOrientationProperty: true]))
    #expect(upright.extent == CGRect(x: 0, y: 0, width: 16, height: 32) && upright.url == nil)
  }

  @Test func unreadableFilesGiveNil() throws {
    #expect(RenderedImage(data: Data("no image".utf8)) == nil)
    #expect(RenderedImage(contentsOf: URL(fileURLWithPath: "/missing/photo.jpg")) == nil)
  }

  @Test func buffersAreCopied() throws {
    let buffer = try #require(
      CVPixelBuffer(RasterImage(width: 1, height: 1, channels: 3, pixels: [1, 2, 3])))
    let image = RenderedImage(cvPixelBuffer: buffer)
    memset(CVPixelBufferGetBaseAddress(buffer), 0, 4)
    #expect(image.cgImage?.raster.pixels == [1, 2, 3])
    #expect(RenderedImage(cvImageBuffer: buffer).cgImage?.raster.pixels == [0, 0, 0])
  }

  @Test func buffersWithoutColorsAreBlack() throws {
    var buffer: CVPixelBuffer?
    CVPixelBufferCreate(nil, 2, 1, kCVPixelFormatType_DepthFloat32, nil, &buffer)
    let depth = try #require(buffer)
    memset(CVPixelBufferGetBaseAddress(depth), 66, 8)
    #expect(RenderedImage(cvPixelBuffer: depth).cgImage?.raster.pixels == [0, 0])
  }
}

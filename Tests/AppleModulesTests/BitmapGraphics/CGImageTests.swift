import BitmapGraphics
import Foundation
import SceneModel
import TestSupport
import Testing

@Suite struct CGImageTests {
  private func makeImage(
    _ bytes: [UInt8], width: Int, height: Int = 1, bits: Int = 8, bitsPerPixel: Int,
    bytesPerRow: Int, space: CGColorSpace = CGColorSpaceCreateDeviceRGB(),
    info: CGImageAlphaInfo, order: CGBitmapInfo = []
  ) -> CGImage? {
    CGDataProvider(data: Data(bytes)).flatMap {
      CGImage(
        width: width, height: height, bitsPerComponent: bits, bitsPerPixel: bitsPerPixel,
        bytesPerRow: bytesPerRow, space: space,
        bitmapInfo: CGBitmapInfo(rawValue: info.rawValue).union(order), provider: $0, decode: nil,
        shouldInterpolate: false, intent: .defaultIntent)
    }
  }

  @Test(
    arguments: [
      (
        CGImageAlphaInfo.last, CGBitmapInfo.byteOrderDefault, [40, 80, 120, 128],
        [40, 80, 120, 128]
      ),
      (.premultipliedLast, .byteOrderDefault, [20, 40, 60, 128], [40, 80, 120, 128]),
      (.premultipliedFirst, .byteOrder32Little, [60, 40, 20, 128], [40, 80, 120, 128]),
      (.first, .byteOrder32Big, [128, 40, 80, 120], [40, 80, 120, 128]),
      (.noneSkipLast, .byteOrderDefault, [40, 80, 120, 9], [40, 80, 120, 255]),
      (.noneSkipFirst, .byteOrder32Little, [120, 80, 40, 9], [40, 80, 120, 255]),
      // Premultiplied colors are never larger than the opacity; damaged ones are limited to white.
      (.premultipliedLast, .byteOrderDefault, [200, 0, 0, 100], [255, 0, 0, 100]),
      (.premultipliedLast, .byteOrderDefault, [9, 9, 9, 0], [9, 9, 9, 0]),
    ] as [(CGImageAlphaInfo, CGBitmapInfo, [UInt8], [UInt8])])
  func pixelsAreReadByTheirLayout(
    alpha: CGImageAlphaInfo, order: CGBitmapInfo, stored: [UInt8], expected: [UInt8]
  ) throws {
    let image = try #require(
      makeImage(stored, width: 1, bitsPerPixel: 32, bytesPerRow: 4, info: alpha, order: order))
    #expect(image.dataProvider?.data == Data(expected))
    let hasAlpha = alpha != .noneSkipLast && alpha != .noneSkipFirst
    #expect(image.alphaInfo == (hasAlpha ? .last : .noneSkipLast))
    #expect(image.bitsPerPixel == 32 && image.bytesPerRow == 4 && image.bitsPerComponent == 8)
    #expect(image.colorSpace?.name == CGColorSpace.sRGB)
  }

  @Test func grayRowsMayBePadded() throws {
    let image = try #require(
      makeImage(
        [1, 2, 99, 3, 4], width: 2, height: 2, bitsPerPixel: 8, bytesPerRow: 3,
        space: CGColorSpaceCreateDeviceGray(), info: .none))
    #expect(image.dataProvider?.data == Data([1, 2, 3, 4]))
    #expect(image.bitsPerPixel == 8 && image.bytesPerRow == 2 && image.alphaInfo == .none)
    #expect(image.colorSpace?.model == .monochrome && image.bitmapInfo == [])
  }

  @Test func contradictoryDescriptionsAreRefused() {
    let bytes = [UInt8](repeating: 0, count: 16)
    func make(
      _ width: Int = 2, _ height: Int = 2, bits: Int = 8, bitsPerPixel: Int = 32,
      bytesPerRow: Int = 8
    ) -> CGImage? {
      makeImage(
        bytes, width: width, height: height, bits: bits, bitsPerPixel: bitsPerPixel,
        bytesPerRow: bytesPerRow, info: .last)
    }
    #expect(make() != nil)
    #expect(make(0) == nil && make(2, 0) == nil && make(-2) == nil)
    #expect(make(bits: 16) == nil && make(bitsPerPixel: 24) == nil && make(bytesPerRow: 7) == nil)
    // One byte too few.
    #expect(make(2, 3) == nil && make(bytesPerRow: 9) == nil)
    #expect(makeImage(bytes, width: 1, bitsPerPixel: 32, bytesPerRow: 4, info: .none) == nil)
  }

  @Test func croppingCountsFromTheTopLeft() throws {
    let image = CGImage(
      RasterImage(width: 3, height: 2, channels: 1, pixels: [1, 2, 3, 4, 5, 6]))
    func crop(_ x: CGFloat, _ y: CGFloat, _ width: CGFloat, _ height: CGFloat) -> [UInt8]? {
      image.cropping(to: CGRect(x: x, y: y, width: width, height: height))?.raster.pixels
    }
    #expect(crop(1, 0, 2, 1) == [2, 3] && crop(0, 1, 1, 1) == [4])
    // Fractions grow to whole pixels; what lies outside is left out.
    #expect(crop(0.5, 0.5, 1, 1) == [1, 2, 4, 5] && crop(2, 1, 10, 10) == [6])
    #expect(crop(-5, -5, 6, 6) == [1])
    #expect(crop(3, 0, 1, 1) == nil && crop(0, 0, 0, 0) == nil)
    #expect(image.cropping(to: .null) == nil)
    #expect(image.cropping(to: .infinite)?.raster.pixels == [1, 2, 3, 4, 5, 6])
  }

  @Test func copiesHaveThePixels() {
    let raster = RasterImage(width: 1, height: 1, channels: 4, pixels: [1, 2, 3, 4])
    #expect(CGImage(raster).copy()?.raster == raster)
  }

  @Test func providersReadFiles() throws {
    let folder = try TemporaryFolder()
    let url = try folder.write([1, 2, 3], as: "bytes")
    #expect(CGDataProvider(url: url)?.data == Data([1, 2, 3]))
    #expect(CGDataProvider(url: folder.url.appendingPathComponent("missing")) == nil)
  }
}

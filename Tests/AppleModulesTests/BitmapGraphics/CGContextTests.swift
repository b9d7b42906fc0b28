import BitmapGraphics
import Foundation
import Testing

/// Bitmaps of a few pixels, read back byte by byte. Rows are numbered from the top, y from the
/// bottom.
@Suite struct CGContextTests {
  private static let rgba = CGImageAlphaInfo.premultipliedLast.rawValue
  private let clear: [UInt8] = [0, 0, 0, 0]
  private let red: [UInt8] = [255, 0, 0, 255]

  private func context(
    _ width: Int, _ height: Int, _ info: UInt32 = rgba
  ) throws -> CGContext {
    try #require(
      CGContext(
        data: nil, width: width, height: height, bitsPerComponent: 8, bytesPerRow: 0,
        space: CGColorSpaceCreateDeviceRGB(), bitmapInfo: info))
  }

  private func grayContext(_ width: Int, _ height: Int) throws -> CGContext {
    try #require(
      CGContext(
        data: nil, width: width, height: height, bitsPerComponent: 8, bytesPerRow: 0,
        space: CGColorSpaceCreateDeviceGray(), bitmapInfo: CGImageAlphaInfo.none.rawValue))
  }

  private func pixel(_ context: CGContext, _ x: Int, _ row: Int) throws -> [UInt8] {
    let size = context.bitsPerPixel / 8
    let start = try #require(context.data) + row * context.bytesPerRow + x * size
    return Array(UnsafeRawBufferPointer(start: start, count: size))
  }

  /// The gray values row by row from the top.
  private func rows(_ context: CGContext) throws -> [[UInt8]] {
    try (0..<context.height).map { row in
      try (0..<context.width).map { try pixel(context, $0, row)[0] }
    }
  }

  private func gray(_ width: Int, _ pixels: [UInt8]) throws -> CGImage {
    let provider = try #require(CGDataProvider(data: Data(pixels)))
    return try #require(
      CGImage(
        width: width, height: pixels.count / width, bitsPerComponent: 8, bitsPerPixel: 8,
        bytesPerRow: width, space: CGColorSpaceCreateDeviceGray(), bitmapInfo: [],
        provider: provider, decode: nil, shouldInterpolate: false, intent: .defaultIntent))
  }

  @Test func unsupportedBitmapsAreRefused() {
    func make(
      _ width: Int = 2, _ height: Int = 2, bits: Int = 8, bytesPerRow: Int = 0,
      space: CGColorSpace = CGColorSpaceCreateDeviceRGB(), info: UInt32 = Self.rgba
    ) -> CGContext? {
      CGContext(
        data: nil, width: width, height: height, bitsPerComponent: bits, bytesPerRow: bytesPerRow,
        space: space, bitmapInfo: info)
    }
    #expect(make() != nil)
    #expect(make(0) == nil && make(2, -1) == nil && make(65537) == nil)
    #expect(make(bits: 16) == nil && make(bytesPerRow: 7) == nil && make(bytesPerRow: 8) != nil)
    #expect(make(info: CGImageAlphaInfo.none.rawValue) == nil)
    #expect(make(info: Self.rgba | CGBitmapInfo.floatComponents.rawValue) == nil)
    #expect(make(info: Self.rgba | CGBitmapInfo.byteOrder16Little.rawValue) == nil)
    #expect(make(space: CGColorSpaceCreateDeviceGray()) == nil)
    #expect(make(info: 0x1F) == nil)
  }

  @Test func rowsAreAMultipleOf64BytesUnlessSpecified() throws {
    #expect(try context(17, 1).bytesPerRow == 128)
    #expect(try grayContext(64, 1).bytesPerRow == 64)
  }

  @Test(
    arguments: [
      (CGImageAlphaInfo.premultipliedLast, CGBitmapInfo.byteOrderDefault, [10, 20, 30, 255]),
      (.premultipliedLast, .byteOrder32Big, [10, 20, 30, 255]),
      (.premultipliedLast, .byteOrder32Little, [255, 30, 20, 10]),
      (.premultipliedFirst, .byteOrder32Big, [255, 10, 20, 30]),
      (.premultipliedFirst, .byteOrder32Little, [30, 20, 10, 255]),
      (.noneSkipLast, .byteOrderDefault, [10, 20, 30, 255]),
      (.noneSkipFirst, .byteOrder32Little, [30, 20, 10, 255]),
    ] as [(CGImageAlphaInfo, CGBitmapInfo, [UInt8])])
  func componentsLieInTheirOrder(
    alpha: CGImageAlphaInfo, order: CGBitmapInfo, expected: [UInt8]
  ) throws {
    let context = try context(1, 1, alpha.rawValue | order.rawValue)
    context.setFillColor(red: 10 / 255, green: 20 / 255, blue: 30 / 255, alpha: 1)
    context.fill(CGRect(x: 0, y: 0, width: 1, height: 1))
    #expect(try pixel(context, 0, 0) == expected)
    #expect(context.alphaInfo == alpha && context.bitmapInfo.intersection(.byteOrderMask) == order)
  }

  @Test func yPointsUp() throws {
    let context = try context(3, 3)
    context.setFillColor(red: 1, green: 0, blue: 0, alpha: 1)
    context.fill(CGRect(x: 0, y: 0, width: 2, height: 1))
    #expect(try pixel(context, 0, 2) == red && pixel(context, 1, 2) == red)
    #expect(try pixel(context, 2, 2) == clear && pixel(context, 0, 1) == clear)
  }

  @Test func shapesCoverThePixelsWhoseCentersTheyContain() throws {
    let context = try grayContext(4, 1)
    context.setFillColor(gray: 1, alpha: 1)
    context.fill(CGRect(x: 0.6, y: 0, width: 2.0, height: 1))
    #expect(try rows(context) == [[0, 255, 255, 0]])
  }

  @Test func severalRectanglesAreFilled() throws {
    let context = try grayContext(3, 1)
    context.setFillColor(gray: 1, alpha: 1)
    context.fill([
      CGRect(x: 0, y: 0, width: 1, height: 1), CGRect(x: 2, y: 0, width: 9, height: 9),
    ])
    #expect(try rows(context) == [[255, 0, 255]])
  }

  @Test func opacityMixesWithTheBackground() throws {
    let context = try grayContext(1, 1)
    let all = CGRect(x: 0, y: 0, width: 1, height: 1)
    context.setFillColor(.white)
    context.fill(all)
    context.setFillColor(gray: 0, alpha: 0.5)
    context.fill(all)
    // 255 · (1 − 128 / 255).
    #expect(try rows(context) == [[127]])
    context.setFillColor(.clear)
    context.fill(all)
    #expect(try rows(context) == [[127]])
  }

  @Test func premultipliedPixelsStoreProducts() throws {
    let context = try context(1, 1)
    let all = CGRect(x: 0, y: 0, width: 1, height: 1)
    context.setFillColor(red: 1, green: 0.5, blue: 0, alpha: 0.5)
    context.fill(all)
    #expect(try pixel(context, 0, 0) == [128, 64, 0, 128])
    // The same color over itself: the opacity grows, the color stays.
    context.fill(all)
    // 128 + 128 · 127 / 255 is 191.7.
    #expect(try pixel(context, 0, 0) == [192, 96, 0, 192])
  }

  @Test func plainAlphaLeavesColorsUnchanged() throws {
    let context = try context(1, 1, CGImageAlphaInfo.last.rawValue)
    context.setFillColor(red: 1, green: 0.5, blue: 0, alpha: 0.5)
    context.fill(CGRect(x: 0, y: 0, width: 1, height: 1))
    #expect(try pixel(context, 0, 0) == [255, 128, 0, 128])
  }

  @Test func alphaOnlyContextsKeepOpacity() throws {
    let context = try context(2, 1, CGImageAlphaInfo.alphaOnly.rawValue)
    context.setFillColor(red: 1, green: 1, blue: 1, alpha: 0.5)
    context.fill(CGRect(x: 1, y: 0, width: 1, height: 1))
    #expect(context.bitsPerPixel == 8)
    #expect(try rows(context) == [[0, 128]])
  }

  @Test func graysHaveTheWeightsOfRec601() throws {
    let context = try grayContext(3, 1)
    let colors: [(CGFloat, CGFloat, CGFloat)] = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    for (x, color) in colors.enumerated() {
      context.setFillColor(red: color.0, green: color.1, blue: color.2, alpha: 1)
      context.fill(CGRect(x: x, y: 0, width: 1, height: 1))
    }
    #expect(try rows(context) == [[76, 150, 29]])
  }

  @Test func contextOpacityAppliesToAllDrawing() throws {
    let context = try grayContext(2, 1)
    context.setAlpha(0.2)
    context.setFillColor(.white)
    context.fill(CGRect(x: 0, y: 0, width: 1, height: 1))
    context.draw(try gray(1, [255]), in: CGRect(x: 1, y: 0, width: 1, height: 1))
    #expect(try rows(context) == [[51, 51]])
  }

  @Test func clippingIntersectsAndIsRestored() throws {
    let context = try grayContext(4, 2)
    let all = CGRect(x: 0, y: 0, width: 4, height: 2)
    context.setFillColor(.white)
    context.saveGState()
    context.clip(to: CGRect(x: 0, y: 0, width: 3, height: 2))
    context.clip(to: CGRect(x: 1, y: 1, width: 3, height: 1))
    context.fill(all)
    #expect(try rows(context) == [[0, 255, 255, 0], [0, 0, 0, 0]])
    context.clip(to: CGRect(x: 3, y: 0, width: 1, height: 1))
    context.setFillColor(gray: 0.2, alpha: 1)
    context.fill(all)
    context.draw(try gray(1, [9]), in: all)
    #expect(try rows(context) == [[0, 255, 255, 0], [0, 0, 0, 0]])
    context.restoreGState()
    context.fill(all)
    #expect(try rows(context) == [[255, 255, 255, 255], [255, 255, 255, 255]])
  }

  @Test func stateIsSavedInAStack() throws {
    let context = try grayContext(3, 1)
    context.setFillColor(gray: 1, alpha: 1)
    context.saveGState()
    context.translateBy(x: 1, y: 0)
    context.interpolationQuality = .none
    context.saveGState()
    context.translateBy(x: 1, y: 0)
    #expect(context.ctm == CGAffineTransform(translationX: 2, y: 0))
    context.restoreGState()
    #expect(context.ctm == CGAffineTransform(translationX: 1, y: 0))
    context.restoreGState()
    #expect(context.ctm.isIdentity && context.interpolationQuality == .default)
    // Without a saved state nothing changes.
    context.restoreGState()
    context.fill(CGRect(x: 0, y: 0, width: 1, height: 1))
    #expect(try rows(context) == [[255, 0, 0]])
  }

  @Test func laterTransformsApplyFirst() throws {
    let context = try grayContext(4, 1)
    context.translateBy(x: 1, y: 0)
    context.scaleBy(x: 2, y: 1)
    context.setFillColor(.white)
    context.fill(CGRect(x: 0.5, y: 0, width: 0.5, height: 1))
    #expect(try rows(context) == [[0, 0, 255, 0]])
    #expect(context.ctm == CGAffineTransform(a: 2, b: 0, c: 0, d: 1, tx: 1, ty: 0))
  }

  @Test func clearingSetsZeros() throws {
    let context = try context(2, 1)
    context.setFillColor(.white)
    context.fill(CGRect(x: 0, y: 0, width: 2, height: 1))
    context.clear(CGRect(x: 1, y: -3, width: 7, height: 9))
    #expect(try pixel(context, 0, 0) == [255, 255, 255, 255] && pixel(context, 1, 0) == clear)
  }

  @Test func ellipsesTouchTheirRectangle() throws {
    let context = try grayContext(5, 5)
    context.setFillColor(.white)
    context.fillEllipse(in: CGRect(x: 0, y: 0, width: 5, height: 5))
    let full: [UInt8] = [255, 255, 255, 255, 255]
    let narrow: [UInt8] = [0, 255, 255, 255, 0]
    #expect(try rows(context) == [narrow, full, full, full, narrow])
  }

  @Test func imagesAreUpright() throws {
    let context = try grayContext(3, 3)
    context.draw(try gray(2, [1, 2, 3, 4]), in: CGRect(x: 1, y: 0, width: 2, height: 2))
    #expect(try rows(context) == [[0, 0, 0], [0, 1, 2], [0, 3, 4]])
  }

  @Test func nearestPixelsAreRepeated() throws {
    let context = try grayContext(4, 2)
    context.interpolationQuality = .none
    context.draw(try gray(2, [10, 200]), in: CGRect(x: 0, y: 0, width: 4, height: 2))
    #expect(try rows(context) == [[10, 10, 200, 200], [10, 10, 200, 200]])
  }

  @Test func enlargedImagesAreInterpolatedLinearly() throws {
    let context = try grayContext(4, 1)
    context.draw(try gray(2, [0, 100]), in: CGRect(x: 0, y: 0, width: 4, height: 1))
    #expect(try rows(context) == [[0, 25, 75, 100]])
  }

  @Test func reducedImagesAreAveraged() throws {
    let context = try grayContext(2, 1)
    let image = try gray(4, [0, 100, 40, 60, 20, 80, 200, 100])
    context.draw(image, in: CGRect(x: 0, y: 0, width: 2, height: 1))
    #expect(try rows(context) == [[50, 100]])
  }

  @Test func transformsTurnImages() throws {
    let context = try grayContext(2, 2)
    // A quarter counter-clockwise about the bitmap's center.
    context.translateBy(x: 2, y: 0)
    context.rotate(by: .pi / 2)
    context.draw(try gray(2, [1, 2, 3, 4]), in: CGRect(x: 0, y: 0, width: 2, height: 2))
    #expect(try rows(context) == [[2, 4], [1, 3]])
  }

  @Test func transformsMirrorImages() throws {
    let context = try grayContext(2, 2)
    context.concatenate(CGAffineTransform(a: 1, b: 0, c: 0, d: -1, tx: 0, ty: 2))
    context.draw(try gray(2, [1, 2, 3, 4]), in: CGRect(x: 0, y: 0, width: 2, height: 2))
    #expect(try rows(context) == [[3, 4], [1, 2]])
  }

  @Test func partsOutsideTheBitmapAreCutOff() throws {
    let context = try grayContext(2, 2)
    context.draw(try gray(2, [1, 2, 3, 4]), in: CGRect(x: -1, y: 1, width: 2, height: 2))
    #expect(try rows(context) == [[4, 0], [0, 0]])
    context.draw(try gray(1, [9]), in: CGRect(x: 50, y: 50, width: 5, height: 5))
    context.draw(try gray(1, [9]), in: CGRect(x: 0, y: 0, width: 0, height: 5))
    context.draw(try gray(1, [9]), in: .null)
    #expect(try rows(context) == [[4, 0], [0, 0]])
  }

  @Test func callersMemoryIsDrawnIntoAndNothingElse() throws {
    // Two rows of three bytes, four apart, and a byte behind the last pixel.
    var memory = [UInt8](repeating: 7, count: 8)
    try memory.withUnsafeMutableBytes { bytes in
      let context = try #require(
        CGContext(
          data: bytes.baseAddress, width: 3, height: 2, bitsPerComponent: 8, bytesPerRow: 4,
          space: CGColorSpaceCreateDeviceGray(), bitmapInfo: 0))
      #expect(context.data == bytes.baseAddress)
      context.setFillColor(.white)
      context.fill(CGRect(x: -5, y: -5, width: 20, height: 20))
      context.clear(CGRect(x: 1, y: 0, width: 1, height: 1))
    }
    #expect(memory == [255, 255, 255, 7, 255, 0, 255, 7])
  }

  @Test func imagesOfAContextAreCopies() throws {
    let context = try context(1, 1)
    context.setFillColor(red: 1, green: 0.5, blue: 0, alpha: 0.5)
    context.fill(CGRect(x: 0, y: 0, width: 1, height: 1))
    let image = try #require(context.makeImage())
    context.clear(CGRect(x: 0, y: 0, width: 1, height: 1))
    // Colors are divided by the opacity again: 64 · 255 / 128 rounds to 128.
    #expect(image.alphaInfo == .last)
    #expect(image.dataProvider?.data == Data([255, 128, 0, 128]))
  }
}

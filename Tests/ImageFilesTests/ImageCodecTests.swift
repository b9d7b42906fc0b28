import Foundation
import ImageFiles
import SceneModel
import TestSupport
import Testing

@testable import Kernels

@Suite struct ImageCodecTests {
  /// Red increases to the right, green downward; blue is a checkerboard.
  private func pattern(width: Int = 48, height: Int = 32) -> RasterImage {
    var image = RasterImage(width: width, height: height, channels: 3)
    for y in 0..<height {
      for x in 0..<width {
        let at = (y * width + x) * 3
        image.pixels[at] = UInt8(x * 5 % 256)
        image.pixels[at + 1] = UInt8(y * 7 % 256)
        image.pixels[at + 2] = (x / 8 + y / 8) % 2 == 0 ? 40 : 200
      }
    }
    return image
  }

  @Test func pngKeepsEveryPixel() throws {
    let image = pattern()
    let bytes = try ImageCodec.encodePNG(image)
    #expect(try ImageCodec.decode(bytes) == image)
    #expect(try ImageCodec.encodePNG(image) == bytes)
    #expect(try ImageHeader(bytes) == ImageHeader(format: .png, width: 48, height: 32))
  }

  @Test func pngKeepsGradientsAndNoiseOfAnySize() throws {
    var random = SplitMix64(seed: 5)
    for (width, height) in [(1, 1), (1, 9), (17, 1), (33, 21), (300, 5)] {
      var image = RasterImage(width: width, height: height, channels: 3)
      for y in 0..<height {
        for x in 0..<(3 * width) {
          // Rows that favor different filters: constant, rising, slanted, noise.
          image.pixels[3 * width * y + x] =
            switch y % 4 {
            case 0: 200
            case 1: UInt8(truncatingIfNeeded: 5 * x)
            case 2: UInt8(truncatingIfNeeded: 3 * x + 11 * y)
            default: UInt8.random(in: 0...255, using: &random)
            }
        }
      }
      #expect(try ImageCodec.decode(ImageCodec.encodePNG(image)) == image)
    }
  }

  @Test func webPIsCloseAndDeterministic() throws {
    let image = pattern()
    let bytes = try ImageCodec.encodeWebP(image, .lossy(quality: 0.95))
    #expect(try ImageHeader(bytes) == ImageHeader(format: .webP, width: 48, height: 32))
    let decoded = try ImageCodec.decode(bytes)
    let error = zip(image.pixels, decoded.pixels).map { abs(Int($0) - Int($1)) }.reduce(0, +)
    #expect(Double(error) / Double(image.pixels.count) < 8)
    #expect(try ImageCodec.encodeWebP(image, .lossy(quality: 0.95)) == bytes)
    #expect(try ImageCodec.encodeWebP(image, .lossy(quality: 0.2)).count < bytes.count)
  }

  @Test func losslessWebPKeepsEveryPixel() throws {
    let image = pattern()
    #expect(try ImageCodec.decode(ImageCodec.encodeWebP(image, .lossless)) == image)
    let gray = RasterImage(
      width: 5, height: 3, channels: 1, pixels: (0..<15).map { UInt8(16 * $0) })
    let decoded = try ImageCodec.decode(ImageCodec.encodeWebP(gray, .lossless))
    #expect(decoded.pixels == gray.pixels.flatMap { [$0, $0, $0] })
  }

  @Test func imagesThatWebPCannotStoreAreRejected() {
    for (width, height, channels) in [(16384, 1, 3), (1, 16384, 1), (2, 2, 4)] {
      let image = RasterImage(width: width, height: height, channels: channels)
      #expect(throws: KernelError.self) { try ImageCodec.encodeWebP(image, .lossless) }
    }
  }

  @Test func jpegIsCloseAndDeterministic() throws {
    let image = pattern()
    let bytes = try ImageCodec.encodeJPEG(image, quality: 0.95)
    let decoded = try ImageCodec.decode(bytes)
    let error = zip(image.pixels, decoded.pixels).map { abs(Int($0) - Int($1)) }.reduce(0, +)
    #expect(Double(error) / Double(image.pixels.count) < 8)
    #expect(try ImageCodec.encodeJPEG(image, quality: 0.95) == bytes)
    #expect(try ImageCodec.encodeJPEG(image, quality: 0.2).count < bytes.count)
  }

  @Test func grayAndAlphaBecomeRGB() throws {
    let gray = RasterImage(width: 5, height: 4, channels: 1, filledWith: 77)
    #expect(
      try ImageCodec.decode(ImageCodec.encodePNG(gray))
        == RasterImage(width: 5, height: 4, channels: 3, filledWith: 77))
    var transparent = RasterImage(width: 5, height: 4, channels: 4, filledWith: 90)
    for index in stride(from: 3, to: 80, by: 4) { transparent.pixels[index] = 0 }
    #expect(
      try ImageCodec.decode(ImageCodec.encodePNG(transparent))
        == RasterImage(width: 5, height: 4, channels: 3, filledWith: 90))
  }

  @Test func alphaIsDecodedSeparately() throws {
    var image = RasterImage(width: 6, height: 4, channels: 4, filledWith: 90)
    var alpha = RasterImage(width: 6, height: 4, channels: 1)
    for index in alpha.pixels.indices {
      alpha.pixels[index] = UInt8(index * 10)
      image.pixels[4 * index + 3] = UInt8(index * 10)
    }
    let png = try ImageCodec.encodePNG(image)
    #expect(try ImageCodec.decodeAlpha(png) == alpha)
    #expect(try ImageCodec.decodeAlpha(TIFFWriter.rgba(image)) == alpha)
    // Its color channels are rotated too.
    let upsideDown = TIFFWriter.rgba(image, orientation: 3)
    #expect(try ImageCodec.decodeAlpha(upsideDown) == alpha.turned(byOrientation: 3))
    #expect(try ImageCodec.decode(upsideDown).width == 6)
    let webP = try ImageCodec.decodeAlpha(Self.webP)
    #expect(webP == RasterImage(width: 2, height: 1, channels: 1, pixels: [0, 128]))
    for opaque in [
      try ImageCodec.encodePNG(pattern()), try ImageCodec.encodeJPEG(pattern(), quality: 0.9),
    ] {
      #expect(try ImageCodec.decodeAlpha(opaque) == nil)
    }
    #expect(throws: ImageError.self) { try ImageCodec.decodeAlpha(Array(png.dropLast(30))) }
  }

  /// Two pixels without loss, the first of which is transparent: (200, 100, 50), (10, 20, 30).
  private static let webP: [UInt8] = [
    0x52, 0x49, 0x46, 0x46, 0x20, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50,
    0x56, 0x50, 0x38, 0x4C, 0x14, 0x00, 0x00, 0x00, 0x2F, 0x01, 0x00, 0x00,
    0x10, 0x0F, 0x70, 0x0A, 0xA8, 0x2B, 0xF8, 0x9E, 0xC2, 0xA3, 0x80, 0xC1,
    0x21, 0x23, 0xFA, 0x1F,
  ]

  @Test func webPKeepsTheColorsOfTransparentPixels() throws {
    #expect(
      try ImageCodec.decode(Self.webP)
        == RasterImage(width: 2, height: 1, channels: 3, pixels: [200, 100, 50, 10, 20, 30]))
  }

  @Test(arguments: 1...8) func tiffIsUprightAndKeepsTransparentColors(orientation: Int) throws {
    let colors = pattern(width: 7, height: 5)
    var image = RasterImage(width: 7, height: 5, channels: 4)
    for pixel in 0..<35 {
      for channel in 0..<3 {
        image.pixels[4 * pixel + channel] = colors.pixels[3 * pixel + channel]
      }
      image.pixels[4 * pixel + 3] = UInt8(pixel % 3 * 100)
    }
    #expect(
      try ImageCodec.decode(TIFFWriter.rgba(image, orientation: orientation))
        == colors.turned(byOrientation: orientation))
  }

  @Test func numbersAreReadExactly() throws {
    let values: [Float] = [0, -1.5, .infinity, 3e-20, 7, 1e20]
    let decoded = try ImageCodec.decodeNumbers(
      TIFFWriter.numbers(width: 3, height: 2, values))
    #expect(decoded.width == 3 && decoded.height == 2 && decoded.values == values)
    for colors in [
      try ImageCodec.encodePNG(pattern()),
      TIFFWriter.rgba(RasterImage(width: 2, height: 2, channels: 4)),
    ] {
      #expect(throws: ImageError.self) { try ImageCodec.decodeNumbers(colors) }
    }
    // As a photo, it is of an unsupported kind, but not damaged.
    #expect(throws: ImageHeader.Format.tiff.unsupportedVariant) {
      try ImageCodec.decode(TIFFWriter.numbers(width: 3, height: 2, values))
    }
  }

  @Test(arguments: [8, 24, 32], [true, false])
  func bitmapsAreDecoded(bits: Int, isTopDown: Bool) throws {
    let image = pattern(width: 5, height: 3)
    var expected = image
    if bits == 8 {
      let colors = stride(from: 0, to: image.pixels.count, by: 3).map {
        BMPWriter.color(image.pixels[$0])
      }
      expected.pixels = Array(colors.joined())
    }
    let bytes = BMPWriter.file(image, bits: bits, isTopDown: isTopDown)
    #expect(try ImageCodec.decode(bytes) == expected)
    #expect(throws: ImageError.self) { try ImageCodec.decode(Array(bytes.dropLast(1))) }
    #expect(throws: ImageHeader.Format.bmp.unsupportedVariant) {
      try ImageCodec.decode(BMPWriter.file(image, bits: bits, compression: 1))
    }
  }

  @Test func dilationUsesASquareWindow() throws {
    var image = RasterImage(width: 9, height: 7, channels: 1)
    image.pixels[3 * 9 + 4] = 200
    let wide = try image.dilated(by: 2)
    for y in 0..<7 {
      for x in 0..<9 {
        #expect(wide.pixels[9 * y + x] == (abs(x - 4) <= 2 && abs(y - 3) <= 2 ? 200 : 0))
      }
    }
    #expect(try image.dilated(by: 0) == image)
    #expect(throws: KernelError.self) { try pattern().dilated(by: 1) }
  }

  @Test(arguments: [0.2, 0.5, 0.9]) func truncatedFilesAreDamaged(fraction: Double) throws {
    for bytes in [
      try ImageCodec.encodeJPEG(pattern(width: 200, height: 200), quality: 0.9),
      try ImageCodec.encodePNG(pattern(width: 200, height: 200)),
    ] {
      let cut = Array(bytes.prefix(Int(Double(bytes.count) * fraction)))
      let error = #expect(throws: ImageError.self) { try ImageCodec.decode(cut) }
      guard case .damaged = error else {
        Issue.record("\(String(describing: error))")
        continue
      }
    }
  }

  @Test func oversizedHeadersAreRejectedBeforeDecoding() throws {
    var bytes = try ImageCodec.encodePNG(pattern())
    bytes.replaceSubrange(16..<24, with: [0, 1, 0, 0, 0, 1, 0, 0])
    #expect(throws: ImageError.tooLarge(width: 65536, height: 65536)) {
      try ImageCodec.decode(bytes)
    }
  }

  @Test func otherContentIsIdentified() {
    #expect(throws: ImageError.unsupportedFormat("a GIF image")) {
      try ImageHeader(Array("GIF89a".utf8))
    }
    #expect(throws: ImageError.notAnImage("a text file")) {
      try ImageHeader(Array("just some notes\n".utf8))
    }
    #expect(throws: ImageError.self) { try ImageHeader([]) }
  }

  @Test func truncatedHeadersNeverCrash() throws {
    let bytes = try ImageCodec.encodeJPEG(pattern(), quality: 0.5)
    for count in 0..<min(700, bytes.count) {
      guard let header = try? ImageHeader(Array(bytes.prefix(count))) else { continue }
      #expect(header == ImageHeader(format: .jpeg, width: 48, height: 32))
    }
    let tiff: [UInt8] = [0x49, 0x49, 42, 0, 8, 0, 0, 0, 0xFF, 0xFF, 0, 1, 4, 0]
    #expect(throws: ImageError.self) { try ImageCodec.decode(tiff) }
  }

  /// Where the stored top-left pixel ends up for each orientation, as defined in the EXIF standard.
  @Test(
    arguments: zip(
      1...8,
      [(0, 0), (2, 0), (2, 1), (0, 1), (0, 0), (1, 0), (1, 2), (0, 2)]))
  func orientationsAreAppliedUpright(orientation: Int, corner: (x: Int, y: Int)) throws {
    // 3 × 2: the top-left pixel is 1, its right neighbor 2, the one below 4.
    let stored = RasterImage(width: 3, height: 2, channels: 1, pixels: [1, 2, 3, 4, 5, 6])
    let upright = try stored.turned(byOrientation: orientation)
    #expect(upright.width == (orientation < 5 ? 3 : 2))
    #expect(upright.pixels[corner.y * upright.width + corner.x] == 1)
    let expected: [[UInt8]] = [
      [1, 2, 3, 4, 5, 6], [3, 2, 1, 6, 5, 4], [6, 5, 4, 3, 2, 1], [4, 5, 6, 1, 2, 3],
      [1, 4, 2, 5, 3, 6], [4, 1, 5, 2, 6, 3], [6, 3, 5, 2, 4, 1], [3, 6, 2, 5, 1, 4],
    ]
    #expect(upright.pixels == expected[orientation - 1])
  }

  @Test func reducingAverages() throws {
    let image = RasterImage(
      width: 4, height: 2, channels: 1, pixels: [0, 10, 20, 30, 40, 50, 60, 70])
    let half = try image.resized(width: 2, height: 1)
    #expect(half.pixels == [25, 45])
  }

  @Test func undistortionFollowsTheCameraModel() throws {
    let camera = Camera(
      width: 320, height: 240, focalLength: [280, 282], principalPoint: [158, 121],
      distortion: [-0.2, 0.05, 0.001, -0.002])
    let pinhole = Camera(
      width: 300, height: 220, focalLength: [270, 270], principalPoint: [150, 108])
    // A smooth image, so that the interpolation error is negligible.
    func value(_ p: SIMD2<Double>) -> Double { 40 + 0.5 * p.x + 0.2 * p.y }
    var image = RasterImage(width: 320, height: 240, channels: 1)
    for index in image.pixels.indices {
      let p = SIMD2(Double(index % 320) + 0.5, Double(index / 320) + 0.5)
      image.pixels[index] = UInt8(value(p).rounded())
    }
    let result = try image.undistorted(from: camera, to: pinhole)
    var worst = 0.0
    for (x, y) in [(40, 30), (150, 108), (260, 40), (35, 190), (270, 200)] {
      let ray = pinhole.unproject([Double(x) + 0.5, Double(y) + 0.5])
      let source = camera.project([ray.x, ray.y, 1])
      worst = max(worst, abs(value(source) - Double(result.pixels[y * 300 + x])))
    }
    #expect(worst < 1.1)
  }
}

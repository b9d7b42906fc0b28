import DamagedInput
import Foundation
import ImageFiles
import SceneModel
import TestSupport
import Testing

@Suite struct OpenEXRTests {
  /// 8-bit sRGB of a linear value.
  private func encoded(_ linear: Float) -> Int {
    let value = Double(min(max(linear, 0), 1))
    return Int(
      (255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055)).rounded())
  }

  /// Slopes from below 0 to above 1, with opaque pixels on the right.
  private func slopes(width: Int = 37, height: Int = 21) -> EXRWriter {
    func channel(_ value: (Int, Int) -> Float) -> [Float] {
      (0..<height).flatMap { y in (0..<width).map { value($0, y) } }
    }
    return EXRWriter(
      width: width, height: height,
      [
        "R": channel { x, _ in Float(x) / Float(width) * 1.4 - 0.2 },
        "G": channel { _, y in Float(y) / Float(height) },
        "B": channel { x, y in Float(x * y % 7) / 100 },
        "A": channel { x, _ in x < 10 ? 0 : 1 },
      ])
  }

  @Test(arguments: [EXRWriter.Sample.half, .float], [nil, 8, 64] as [Int?])
  func linearColorsAreEncodedAndClipped(sample: EXRWriter.Sample, tileSide: Int?) throws {
    var writer = slopes()
    writer.sample = sample
    writer.tileSide = tileSide
    let bytes = writer.file
    #expect(try ImageHeader(bytes) == ImageHeader(format: .openEXR, width: 37, height: 21))
    let image = try ImageCodec.decode(bytes)
    try #require((image.width, image.height, image.channels) == (37, 21, 3))
    for (channel, name) in ["R", "G", "B"].enumerated() {
      for (index, value) in (writer.channels[name] ?? []).enumerated() {
        #expect(abs(Int(image.pixels[3 * index + channel]) - encoded(value)) <= 1)
      }
    }
    let alpha = try #require(try ImageCodec.decodeAlpha(bytes))
    #expect(alpha.pixels.enumerated().allSatisfy { $1 == ($0 % 37 < 10 ? 0 : 255) })
    #expect(try ImageCodec.decodeNumbersOrNil(bytes) == nil)
  }

  @Test func luminanceIsGray() throws {
    let bytes = EXRWriter(width: 2, height: 1, ["Y": [0.5, 0.1]]).file
    #expect(!ImageHeader.declaresAlpha(bytes))
    let image = try ImageCodec.decode(bytes)
    #expect(image.pixels == [188, 188, 188, 89, 89, 89])
  }

  private func pixel(_ image: RasterImage, _ x: Int, _ y: Int) -> [UInt8] {
    let start = 3 * (y * image.width + x)
    return Array(image.pixels[start..<start + 3])
  }

  /// The display window is the photo; pixels without data are black.
  @Test func windowsMayDiffer() throws {
    var writer = slopes()
    let whole = try ImageCodec.decode(writer.file)
    writer.origin = SIMD2(-5, 3)
    writer.display = (SIMD2(0, 0), SIMD2(20, 10))
    for tileSide in [nil, 8] as [Int?] {
      writer.tileSide = tileSide
      let image = try ImageCodec.decode(writer.file)
      try #require((image.width, image.height) == (20, 10))
      for y in 0..<10 {
        for x in 0..<20 {
          let expected = y < 3 ? [0, 0, 0] : pixel(whole, x + 5, y - 3)
          #expect(pixel(image, x, y) == expected)
        }
      }
    }
  }

  @Test func primariesAreConverted() throws {
    func color(_ rgb: [Float], _ chromaticities: [Float]) throws -> [UInt8] {
      var writer = EXRWriter(width: 1, height: 1, ["R": [rgb[0]], "G": [rgb[1]], "B": [rgb[2]]])
      writer.chromaticities = chromaticities
      writer.sample = .float
      return try ImageCodec.decode(writer.file).pixels
    }
    let rec709: [Float] = [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329]
    let rec2020: [Float] = [0.708, 0.292, 0.17, 0.797, 0.131, 0.046, 0.3127, 0.329]
    let aces: [Float] = [0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767]
    #expect(try color([0.5, 0.1, 0.2], rec709) == color([0.5, 0.1, 0.2], []))
    // Neutral colors stay neutral, whatever the white.
    for primaries in [rec2020, aces] {
      let gray = try color([0.5, 0.5, 0.5], primaries)
      #expect(gray.allSatisfy { abs(Int($0) - 188) <= 1 })
    }
    // The matrix of ITU-R BT.2087.
    let linear: [Float] = [
      1.6605 * 0.3 - 0.5876 * 0.25 - 0.0728 * 0.2, -0.1246 * 0.3 + 1.1329 * 0.25 - 0.0083 * 0.2,
      -0.0182 * 0.3 - 0.1006 * 0.25 + 1.1187 * 0.2,
    ]
    let converted = try color([0.3, 0.25, 0.2], rec2020)
    for channel in 0..<3 { #expect(abs(Int(converted[channel]) - encoded(linear[channel])) <= 1) }
    // Nonsense is ignored.
    let zeros = [Float](repeating: 0, count: 8)
    #expect(try color([0.5, 0.1, 0.2], zeros) == color([0.5, 0.1, 0.2], []))
  }

  @Test func oneChannelHoldsNumbers() throws {
    let values: [Float] = [1.5, 2.25, 1000, 0.125, -1, .infinity]
    for sample in [EXRWriter.Sample.half, .float] {
      var writer = EXRWriter(width: 3, height: 2, ["Z": values])
      writer.sample = sample
      let numbers = try ImageCodec.decodeNumbers(writer.file)
      #expect((numbers.width, numbers.height) == (3, 2) && numbers.values == values)
      #expect(throws: ImageError.self) { try ImageCodec.decode(writer.file) }
    }
  }

  @Test func otherKindsAreNamed() {
    func error(flags: UInt8) -> ImageError? {
      var bytes = slopes().file
      bytes[5] = flags
      return #expect(throws: ImageError.self) { try ImageHeader(bytes) }
    }
    // Deep data and several parts need attributes that are missing here.
    #expect(error(flags: 8) != nil)
    #expect(error(flags: 16) != nil)
  }

  @Test func limitsHoldBeforeDecoding() {
    var writer = slopes()
    writer.display = (SIMD2(0, 0), SIMD2(200_000, 10))
    #expect(throws: ImageError.tooLarge(width: 200_000, height: 10)) {
      try ImageCodec.decode(writer.file)
    }
  }

  @Test(arguments: [nil, 8] as [Int?]) func damagedFilesGiveAValueOrAnError(tileSide: Int?) throws {
    var writer = slopes()
    writer.tileSide = tileSide
    let whole = DamagedInput(writer.file)
    var limits = ImageCodec.Limits()
    limits.maximumPixels = 1 << 16
    var images = 0
    let copies = Array(whole.truncations(step: 7)) + whole.mutations(3000, seed: 70, header: 500)
    for copy in copies {
      _ = try? ImageCodec.decodeAlpha(copy, limits: limits)
      _ = try? ImageCodec.decodeNumbers(copy, limits: limits)
      guard let image = try? ImageCodec.decode(copy, limits: limits) else { continue }
      #expect(image.pixels.count == image.width * image.height * 3)
      images += 1
    }
    #expect(images > 100 && images < copies.count)
  }
}

extension ImageCodec {
  fileprivate static func decodeNumbersOrNil(_ bytes: [UInt8]) throws -> [Float]? {
    try? decodeNumbers(bytes).values
  }
}

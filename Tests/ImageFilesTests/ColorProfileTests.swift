import Foundation
import ImageFiles
import SceneModel
import TestSupport
import Testing

@testable import Kernels

@Suite struct ColorProfileTests {
  /// Inside sRGB's gamut when interpreted as Display P3.
  private static let colors: [SIMD3<Double>] = [
    [128, 128, 128], [180, 120, 90], [90, 140, 110], [70, 80, 130], [200, 190, 140],
    [255, 255, 255],
    [20, 24, 22],
  ]

  /// Adjacent patches of 8 × 8 pixels.
  private static let patches: RasterImage = {
    var image = RasterImage(width: 8 * colors.count, height: 8, channels: 3)
    for y in 0..<8 {
      for x in 0..<image.width {
        for c in 0..<3 { image.pixels[(y * image.width + x) * 3 + c] = UInt8(colors[x / 8][c]) }
      }
    }
    return image
  }()

  private func expectConverted(
    _ image: RasterImage, within tolerance: Double, _ expected: (SIMD3<Double>) -> SIMD3<Double>
  ) {
    for (index, color) in Self.colors.enumerated() {
      let wanted = expected(color)
      for c in 0..<3 {
        let value = Double(image.pixels[(4 * image.width + 8 * index + 4) * 3 + c])
        #expect(abs(value - wanted[c]) <= tolerance, "\(color) became \(value), not \(wanted)")
      }
    }
  }

  /// By the primaries of both spaces and their common transfer curve.
  private func fromDisplayP3(_ color: SIMD3<Double>) -> SIMD3<Double> {
    let matrix: [SIMD3<Double>] = [
      [1.22494, -0.22494, 0], [-0.04206, 1.04206, 0], [-0.01964, -0.07864, 1.09827],
    ]
    let light = map(color / 255) {
      $0 <= 0.04045 ? $0 / 12.92 : pow(($0 + 0.055) / 1.055, 2.4)
    }
    let linear = SIMD3(matrix.map { ($0 * light).sum() })
    return 255 * map(linear) { $0 <= 0.0031308 ? 12.92 * $0 : 1.055 * pow($0, 1 / 2.4) - 0.055 }
  }

  /// Adobe RGB (1998) to sRGB: both have the same red and blue primaries and white point.
  private func fromAdobeRGB(_ color: SIMD3<Double>) -> SIMD3<Double> {
    let matrix: [SIMD3<Double>] = [
      [1.39836, -0.39836, 0], [0, 1, 0], [0, -0.04293, 1.04293],
    ]
    let light = map(color / 255) { pow($0, 563.0 / 256) }
    let linear = SIMD3(matrix.map { ($0 * light).sum() })
    return 255 * map(linear) { $0 <= 0.0031308 ? 12.92 * $0 : 1.055 * pow($0, 1 / 2.4) - 0.055 }
  }

  private func map(_ value: SIMD3<Double>, _ body: (Double) -> Double) -> SIMD3<Double> {
    SIMD3(body(value.x), body(value.y), body(value.z))
  }

  private let displayP3 = ICCWriter.profile(.displayP3)

  @Test func pngProfilesAreApplied() throws {
    let bytes = png(try ImageCodec.encodePNG(Self.patches), with: displayP3)
    #expect(ColorProfile(bytes) == .icc(displayP3))
    expectConverted(try ImageCodec.decode(bytes), within: 1.01, fromDisplayP3)
  }

  @Test func multipartJPEGProfilesAreApplied() throws {
    let plain = try ImageCodec.encodeJPEG(Self.patches, quality: 1)
    for parts in [1, 3] {
      let bytes = jpeg(plain, with: displayP3, parts: parts)
      #expect(ColorProfile(bytes) == .icc(displayP3))
      expectConverted(try ImageCodec.decode(bytes), within: 4, fromDisplayP3)
    }
  }

  @Test func heicProfilesAreApplied() throws {
    var content = ImageCodec.HEICContent()
    content.quality = 1
    content.colorProfile = displayP3
    let bytes = try ImageCodec.encodeHEIC(Self.patches, content)
    #expect(ColorProfile(bytes) == .icc(displayP3))
    expectConverted(try ImageCodec.decode(bytes), within: 6, fromDisplayP3)
  }

  @Test func adobeRGBIsDetectedFromEXIF() throws {
    let bytes = jpeg(try ImageCodec.encodeJPEG(Self.patches, quality: 1), withKind: "R03")
    #expect(ColorProfile(bytes) == .adobeRGB)
    var image = Self.patches
    try ColorProfile.adobeRGB.convert(&image)
    expectConverted(image, within: 1.01, fromAdobeRGB)
    let ordinary = jpeg(try ImageCodec.encodeJPEG(Self.patches, quality: 1), withKind: "R98")
    #expect(ColorProfile(ordinary) == nil)
    // As if a program had converted it without changing the interoperability index.
    let converted = jpeg(
      try ImageCodec.encodeJPEG(Self.patches, quality: 1), withKind: "R03", colorSpace: 1)
    #expect(ColorProfile(converted) == nil)
  }

  @Test func sRGBColorsAreUnchanged() throws {
    let plain = try ImageCodec.encodePNG(Self.patches)
    #expect(try ImageCodec.decode(png(plain, with: ICCWriter.profile(.sRGB))) == Self.patches)
    #expect(ColorProfile(plain) == nil)
  }

  @Test func damagedProfilesChangeNothing() throws {
    let plain = try ImageCodec.encodePNG(Self.patches)
    var random = SplitMix64(seed: 3)
    #expect(try ImageCodec.decode(png(plain, with: Array(displayP3.prefix(90)))) == Self.patches)
    #expect(try ImageCodec.decode(png(plain, with: [1, 2, 3])) == Self.patches)
    for _ in 0..<200 {
      var profile = displayP3
      for _ in 0..<8 {
        let place = Int.random(in: 0..<profile.count, using: &random)
        profile[place] = UInt8.random(in: 0...255, using: &random)
      }
      // Some are merely different profiles: they may change colors, but not the image's size.
      let image = try ImageCodec.decode(png(plain, with: profile))
      #expect(image.pixels.count == Self.patches.pixels.count)
    }
  }

  // MARK: Writing

  /// A PNG file with a profile after its header; checksums of such chunks aren't verified.
  private func png(_ png: [UInt8], with profile: [UInt8]) -> [UInt8] {
    let size = profile.count
    let stored: [UInt8] = [
      0x78, 1, 1, UInt8(size & 255), UInt8(size >> 8), UInt8(~size & 255), UInt8(~size >> 8 & 255),
    ]
    var (low, high) = (1, 0)
    for byte in profile {
      low = (low + Int(byte)) % 65521
      high = (high + low) % 65521
    }
    let deflated = stored + profile + bigEndian(high << 16 | low)
    let content = Array("iCCP".utf8) + Array("a\0".utf8) + [0] + deflated
    return Array(png.prefix(33)) + bigEndian(content.count - 4) + content + bigEndian(0)
      + png.dropFirst(33)
  }

  private func jpeg(_ jpeg: [UInt8], with profile: [UInt8], parts: Int) -> [UInt8] {
    let size = (profile.count + parts - 1) / parts
    let segments = (0..<parts).flatMap { part in
      let content =
        Array("ICC_PROFILE\0".utf8) + [UInt8(part + 1), UInt8(parts)]
        + profile[min(part * size, profile.count)..<min((part + 1) * size, profile.count)]
      return [0xFF, 0xE2] + bigEndian(content.count + 2, 2) + content
    }
    return Array(jpeg.prefix(2)) + segments + jpeg.dropFirst(2)
  }

  /// A JPEG file whose EXIF data has an interoperability directory with its index.
  private func jpeg(
    _ jpeg: [UInt8], withKind kind: String, colorSpace: Int = 65535
  ) -> [UInt8] {
    func field(_ tag: Int, _ type: Int, _ count: Int, _ value: [UInt8]) -> [UInt8] {
      bigEndian(tag, 2) + bigEndian(type, 2) + bigEndian(count) + value
    }
    func directory(_ fields: [UInt8]...) -> [UInt8] {
      bigEndian(fields.count, 2) + fields.flatMap { $0 } + bigEndian(0)
    }
    let space = field(40961, 3, 1, bigEndian(colorSpace, 2) + [0, 0])
    let tiff =
      Array("MM".utf8) + [0, 42] + bigEndian(8)
      + directory(field(34665, 4, 1, bigEndian(26)))
      + directory(space, field(40965, 4, 1, bigEndian(56)))
      + directory(field(1, 2, 4, Array(kind.utf8) + [0]))
    let content = Array("Exif\0\0".utf8) + tiff
    return Array(jpeg.prefix(2)) + [0xFF, 0xE1] + bigEndian(content.count + 2, 2) + content
      + jpeg.dropFirst(2)
  }
}

import DamagedInput
import Foundation
import ImageFiles
import SceneModel
import TestSupport
import Testing

@Suite struct CameraRawTests {
  /// 8-bit sRGB of a linear value.
  private func encoded(_ linear: Double) -> Double {
    255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055)
  }

  private static let colors: [SIMD3<Double>] = [
    [0.5, 0.5, 0.5], [0.6, 0.1, 0.1], [0.1, 0.5, 0.1], [0.1, 0.15, 0.7], [0.02, 0.02, 0.02],
    [0.7, 0.6, 0.1],
  ]

  /// A card of three by two colors.
  private func card(_ writer: DNGWriter, exposure: Double = 1) -> [UInt8] {
    writer.file { column, row in
      Self.colors[column * 3 / writer.width + 3 * (row * 2 / writer.height)] * exposure
    }
  }

  /// The mean color in the middle of the field `index` of the card.
  private func color(_ image: RasterImage, _ index: Int) -> SIMD3<Double> {
    let (x, y) = (image.width * (2 * (index % 3) + 1) / 6, image.height * (2 * (index / 3) + 1) / 4)
    var sum = SIMD3<Double>()
    for row in y - 2..<y + 2 {
      for column in x - 2..<x + 2 {
        for channel in 0..<3 {
          sum[channel] += Double(image.pixels[(row * image.width + column) * 3 + channel]) / 16
        }
      }
    }
    return sum
  }

  @Test func colorsAreThoseOfTheScene() throws {
    let bytes = card(DNGWriter(width: 96, height: 64))
    #expect(try ImageHeader(bytes) == ImageHeader(format: .cameraRaw, width: 96, height: 64))
    let image = try ImageCodec.decode(bytes)
    try #require((image.width, image.height) == (96, 64))
    for index in Self.colors.indices {
      for channel in 0..<3 {
        let expected = encoded(Self.colors[index][channel])
        let found = color(image, index)[channel]
        #expect(abs(found - expected) < 3, "\(index) \(channel): \(found) \(expected)")
      }
    }
    #expect(try ImageCodec.decode(bytes) == image)
    #expect(try ImageCodec.decodeAlpha(bytes) == nil)
    #expect(ColorProfile(bytes) == nil)
  }

  /// Photos of a set have equal exposure, whatever they show.
  @Test func brightnessIsThatOfTheSensor() throws {
    let image = try ImageCodec.decode(card(DNGWriter(width: 96, height: 64), exposure: 0.25))
    for index in Self.colors.indices {
      let expected = encoded(Self.colors[index].y * 0.25)
      #expect(abs(color(image, index).y - expected) < 3)
    }
    let bright = try ImageCodec.decode(card(DNGWriter(width: 96, height: 64), exposure: 4))
    #expect(color(bright, 0) == SIMD3(repeating: 255))
  }

  @Test(arguments: 1...8) func imagesAreRotatedUpright(orientation: Int) throws {
    var writer = DNGWriter(width: 96, height: 64)
    let stored = try ImageCodec.decode(card(writer))
    writer.orientation = orientation
    let bytes = card(writer)
    let header = try ImageHeader(bytes)
    let image = try ImageCodec.decode(bytes)
    #expect((header.width, header.height) == (image.width, image.height))
    #expect(image == (try stored.turned(byOrientation: orientation)))
    let metadata = PhotoMetadata(bytes)
    #expect(metadata.orientation == 1 && metadata.sensorOrientation == orientation)
  }

  @Test func metadataIsRead() throws {
    var writer = DNGWriter(width: 96, height: 64)
    writer.place = (south: 33, east: 151)
    let metadata = PhotoMetadata(card(writer))
    #expect(metadata.make == "Maker" && metadata.model == "Model 7")
    #expect(metadata.focalLength == 35 && metadata.focalLengthIn35mmFilm == 52)
    #expect(metadata.captureTime == "2024:05:17 12:34:56")
    let position = try #require(metadata.position)
    #expect((position.latitudeDegrees, position.longitudeDegrees) == (-33, 151))
  }

  @Test func otherTIFFFilesAreNotRaw() throws {
    let image = RasterImage(width: 8, height: 8, channels: 4, filledWith: 200)
    #expect(!CameraRawFile.isRaw(TIFFWriter.rgba(image)))
    #expect(!CameraRawFile.isRaw(try ImageCodec.encodeHEIC(image)))
    for start in ["FUJIFILMCCD-RAW 0201", "\0\0\0\u{18}ftypcrx \0\0\0\u{1}"] {
      let bytes = Array(start.utf8) + [UInt8](repeating: 0, count: 400)
      #expect(CameraRawFile.isRaw(bytes))
      #expect(throws: ImageError.self) { try ImageHeader(bytes) }
    }
  }

  @Test func limitsHoldBeforeDecoding() throws {
    var limits = ImageCodec.Limits()
    limits.maximumPixels = 96 * 64 - 1
    #expect(throws: ImageError.tooLarge(width: 96, height: 64)) {
      try ImageCodec.decode(card(DNGWriter(width: 96, height: 64)), limits: limits)
    }
  }

  @Test(arguments: [0.05, 0.3, 0.6, 0.9]) func truncatedFilesAreDamaged(fraction: Double) throws {
    let whole = card(DNGWriter(width: 96, height: 64))
    let cut = Array(whole.prefix(Int(Double(whole.count) * fraction)))
    let error = #expect(throws: ImageError.self) { try ImageCodec.decode(cut) }
    guard case .damaged = error else {
      Issue.record("\(String(describing: error))")
      return
    }
  }

  @Test func damagedFilesGiveAValueOrAnError() throws {
    let whole = DamagedInput(card(DNGWriter(width: 48, height: 32)))
    var limits = ImageCodec.Limits()
    limits.maximumPixels = 1 << 16
    var images = 0
    let copies = Array(whole.truncations(step: 13)) + whole.mutations(3000, seed: 60, header: 900)
    for copy in copies {
      _ = PhotoMetadata(copy)
      _ = ImageHeader.declaresAlpha(copy)
      guard let image = try? ImageCodec.decode(copy, limits: limits) else { continue }
      #expect(image.pixels.count == image.width * image.height * 3)
      images += 1
    }
    #expect(images > 100 && images < copies.count)
  }
}

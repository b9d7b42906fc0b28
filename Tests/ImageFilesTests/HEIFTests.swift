import Foundation
import ImageFiles
import SceneModel
import TestSupport
import Testing

@testable import Kernels

@Suite struct HEIFTests {
  /// Smooth, so that compression loses little: red increases to the right, green downward.
  private func slopes(width: Int = 96, height: Int = 64, channels: Int = 3) -> RasterImage {
    var image = RasterImage(width: width, height: height, channels: channels, filledWith: 90)
    for y in 0..<height {
      for x in 0..<width {
        image.pixels[(y * width + x) * channels] = UInt8(min(40 + x * 2, 230))
        image.pixels[(y * width + x) * channels + 1] = UInt8(min(40 + y * 2, 230))
        if channels == 4 { image.pixels[(y * width + x) * 4 + 3] = x < width / 2 ? 0 : 255 }
      }
    }
    return image
  }

  private func meanDifference(_ a: RasterImage, _ b: RasterImage) -> Double {
    let differences = zip(a.pixels, b.pixels).map { abs(Int($0) - Int($1)) }
    return Double(differences.reduce(0, +)) / Double(max(differences.count, 1))
  }

  @Test func pixelsRoundTrip() throws {
    let bytes = try ImageCodec.encodeHEIC(slopes())
    #expect(try ImageHeader(bytes) == ImageHeader(format: .heic, width: 96, height: 64))
    let decoded = try ImageCodec.decode(bytes)
    #expect(decoded.channels == 3 && meanDifference(decoded, slopes()) < 3)
    #expect(try ImageCodec.decodeAlpha(bytes) == nil)
    #expect(TIFFStructure(exifOf: ByteReader(bytes)) == nil)
    #expect(try ImageCodec.encodeHEIC(slopes()) == bytes)
  }

  @Test(arguments: 1...8) func imagesAreRotatedUpright(orientation: Int) throws {
    var content = ImageCodec.HEICContent()
    content.orientation = orientation
    let bytes = try ImageCodec.encodeHEIC(slopes(), content)
    let upright = try slopes().turned(byOrientation: orientation)
    let header = try ImageHeader(bytes)
    #expect((header.width, header.height) == (upright.width, upright.height))
    let decoded = try ImageCodec.decode(bytes)
    try #require((decoded.width, decoded.height) == (upright.width, upright.height))
    #expect(meanDifference(decoded, upright) < 3)
  }

  @Test func alphaIsDecodedSeparately() throws {
    let bytes = try ImageCodec.encodeHEIC(slopes(channels: 4))
    #expect(ImageHeader.declaresAlpha(bytes))
    let alpha = try #require(try ImageCodec.decodeAlpha(bytes))
    #expect(alpha.channels == 1 && (alpha.width, alpha.height) == (96, 64))
    for x in [4, 40, 56, 90] {
      #expect(abs(Int(alpha.pixels[30 * 96 + x]) - (x < 48 ? 0 : 255)) < 12)
    }
    #expect(meanDifference(try ImageCodec.decode(bytes), slopes()) < 3)
  }

  @Test func metadataIsFound() throws {
    var fields = ExifFields()
    fields.model = "Box"
    var content = ImageCodec.HEICContent()
    content.exif = ExifWriter.tiff(fields)
    let bytes = try ImageCodec.encodeHEIC(slopes(), content)
    let tiff = try #require(TIFFStructure(exifOf: ByteReader(bytes)))
    let model = tiff.entries(ofDirectoryAt: tiff.firstDirectory).first { $0.tag == 272 }
    #expect(model.flatMap { tiff.text($0) } == "Box")
  }

  @Test(arguments: [0.01, 0.1, 0.3, 0.6, 0.95]) func truncatedFilesAreDamaged(
    fraction: Double
  ) throws {
    let bytes = try ImageCodec.encodeHEIC(slopes(width: 256, height: 256))
    let cut = Array(bytes.prefix(max(16, Int(Double(bytes.count) * fraction))))
    let error = #expect(throws: ImageError.self) { try ImageCodec.decode(cut) }
    guard case .damaged = error else {
      Issue.record("\(String(describing: error))")
      return
    }
  }

  @Test func corruptionNeverCrashes() throws {
    var random = SplitMix64(seed: 11)
    let whole = try ImageCodec.encodeHEIC(slopes())
    for round in 0..<300 {
      var bytes = whole
      // Mostly in the boxes before the pixels.
      let end = round % 3 == 0 ? bytes.count : min(bytes.count, 600)
      for _ in 0..<Int.random(in: 1...20, using: &random) {
        bytes[Int.random(in: 8..<end, using: &random)] = UInt8.random(in: 0...255, using: &random)
      }
      _ = try? ImageHeader(bytes)
      _ = TIFFStructure(exifOf: ByteReader(bytes))
      if let image = try? ImageCodec.decode(bytes) {
        #expect(image.pixels.count == image.width * image.height * 3)
      }
    }
  }

  @Test func sequencesAndVideosAreIdentified() {
    func file(_ brands: String...) -> [UInt8] {
      let content =
        Array("ftyp".utf8) + Array(brands[0].utf8) + [0, 0, 0, 0]
        + brands.dropFirst().flatMap { Array($0.utf8) }
      return [0, 0, 0, UInt8(content.count + 4)] + content + [UInt8](repeating: 0, count: 64)
    }
    #expect(throws: ImageError.unsupportedFormat("an image sequence")) {
      try ImageHeader(file("hevc", "hevc"))
    }
    #expect(throws: ImageError.notAnImage("a video")) { try ImageHeader(file("isom", "mp41")) }
    #expect(HEIFFile.Kind(ByteReader(file("mif1", "avif"))) == .image(.avif))
    #expect(HEIFFile.Kind(ByteReader(file("msf1", "hevc", "mif1", "heic"))) == .image(.heic))
  }
}

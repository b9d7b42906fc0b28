import DamagedInput
import Foundation
import ImageFiles
import SceneModel
import TestSupport
import Testing

/// Damaged image files give a value or an error. A parser that traps ends the test process.
@Suite struct DamagedImagesTests {
  enum Sample: String, CaseIterable, CustomTestStringConvertible {
    case jpeg, iPhone, png, tiff, heic, webP, bmp

    var testDescription: String { rawValue }

    /// A valid file of 24 × 16 pixels with the metadata that its format carries.
    func bytes() throws -> [UInt8] {
      let image = TexturePattern.image(width: 24, height: 16, seed: 3)
      var fields = ExifFields()
      fields.orientation = 6
      fields.make = "Maker"
      fields.model = "Model 7"
      fields.focalLength = (414, 10)
      fields.originalSize = (4000, 3000)
      fields.position = (-33.8568, 151.2153, -12.5)
      switch self {
      case .jpeg:
        return ExifWriter.jpeg(try ImageCodec.encodeJPEG(image, quality: 0.8), with: fields)
      case .iPhone:
        let exif = AppleExifWriter.tiff(orientation: 6, acceleration: [0, -1, 0])
        let segment =
          [0xFF, 0xE1] + bigEndian(exif.count + 8, 2) + Array("Exif\0\0".utf8) + exif
        let jpeg = try ImageCodec.encodeJPEG(image, quality: 0.8)
        return Array(jpeg.prefix(2)) + segment + jpeg.dropFirst(2)
      case .png: return try ImageCodec.encodePNG(image)
      case .tiff: return ExifWriter.tiff(fields)
      case .heic:
        var content = ImageCodec.HEICContent()
        content.exif = ExifWriter.tiff(fields)
        content.orientation = 6
        content.colorProfile = ICCWriter.profile(.displayP3)
        return try ImageCodec.encodeHEIC(image, content)
      case .webP: return Self.webP(ExifWriter.tiff(fields))
      case .bmp: return BMPWriter.file(image)
      }
    }

    /// An extended WebP file that announces 24 × 16 pixels, with a profile and EXIF data.
    private static func webP(_ exif: [UInt8]) -> [UInt8] {
      func chunk(_ name: String, _ data: [UInt8]) -> [UInt8] {
        Array(name.utf8) + littleEndian(data.count) + data + (data.count % 2 == 1 ? [0] : [])
      }
      let content =
        Array("WEBP".utf8) + chunk("VP8X", [0x28, 0, 0, 0, 23, 0, 0, 15, 0, 0])
        + chunk("ICCP", ICCWriter.profile(.sRGB)) + chunk("EXIF", exif)
      return Array("RIFF".utf8) + littleEndian(content.count) + content
    }
  }

  /// Reads everything but pixels; whether there is a header.
  private func inspect(_ bytes: [UInt8]) -> Bool {
    let metadata = PhotoMetadata(bytes)
    #expect((1...8).contains(metadata.orientation) && (1...8).contains(metadata.sensorOrientation))
    if let position = metadata.position { #expect(abs(position.latitudeDegrees) <= 90) }
    _ = ColorProfile(bytes)
    _ = ImageHeader.declaresAlpha(bytes)
    guard let header = try? ImageHeader(bytes) else { return false }
    #expect(header.width > 0 && header.height > 0)
    return true
  }

  /// Decodes with limits that keep a damaged size from using up memory.
  private func decode(_ bytes: [UInt8]) -> Bool {
    var limits = ImageCodec.Limits()
    limits.maximumPixels = 1 << 16
    _ = try? ImageCodec.decodeAlpha(bytes, limits: limits)
    _ = try? ImageCodec.decodeNumbers(bytes, limits: limits)
    guard let image = try? ImageCodec.decode(bytes, limits: limits) else { return false }
    #expect(image.pixels.count == image.width * image.height * 3)
    return true
  }

  @Test(arguments: Sample.allCases) func samplesAreValid(sample: Sample) throws {
    let bytes = try sample.bytes()
    // The TIFF structure has metadata only.
    #expect(inspect(bytes) == (sample != .tiff))
    if sample == .iPhone { #expect(PhotoMetadata(bytes).acceleration == [0, -1, 0]) }
    if ![.png, .bmp, .iPhone].contains(sample) {
      let metadata = PhotoMetadata(bytes)
      #expect(metadata.make == "Maker" && metadata.sensorOrientation == 6)
      #expect(metadata.position?.altitude == -12.5)
    }
    if ![.tiff, .webP].contains(sample) { #expect(decode(bytes)) }
  }

  @Test(arguments: Sample.allCases) func truncatedFilesGiveAValueOrAnError(sample: Sample) throws {
    let whole = DamagedInput(try sample.bytes())
    var headers = 0
    for copy in whole.truncations() where inspect(copy) { headers += 1 }
    #expect(headers < whole.bytes.count)
    for copy in whole.truncations(step: 17) { _ = decode(copy) }
  }

  @Test(arguments: Sample.allCases) func damagedHeadersGiveAValueOrAnError(sample: Sample) throws {
    let whole = DamagedInput(try sample.bytes())
    var headers = 0
    for copy in whole.mutations(3000, seed: 40, header: 400) where inspect(copy) { headers += 1 }
    #expect(headers < 3000 && (headers > 100 || sample == .tiff))
  }

  @Test(arguments: Sample.allCases) func damagedPixelsGiveAValueOrAnError(sample: Sample) throws {
    let whole = DamagedInput(try sample.bytes())
    var images = 0
    for copy in whole.mutations(400, seed: 41, header: 400) where decode(copy) { images += 1 }
    #expect(images < 400)
  }

  /// The TIFF structure by itself: every field of every directory, of every type.
  @Test func damagedDirectoriesGiveAValueOrNil() throws {
    let whole = DamagedInput(try Sample.tiff.bytes())
    var fields = 0
    for copy in Array(whole.truncations()) + Array(whole.mutations(4000, seed: 42, header: 200)) {
      guard let tiff = TIFFStructure(ByteReader(copy)) else { continue }
      for entry in tiff.entries(ofDirectoryAt: tiff.firstDirectory) {
        for index in [-1, 0, 1, entry.count - 1, entry.count] {
          _ = (tiff.integer(entry, index), tiff.number(entry, index))
        }
        _ = (tiff.text(entry), tiff.bytes(entry))
        _ = tiff.entries(ofDirectoryAt: tiff.integer(entry) ?? -1)
        fields += 1
      }
    }
    #expect(fields > 1000)
  }

  @Test func damagedSegmentsStayInsideTheFile() throws {
    let whole = DamagedInput(try Sample.jpeg.bytes())
    for copy in Array(whole.truncations()) + Array(whole.mutations(3000, seed: 43, header: 400)) {
      for segment in JPEGSegments(ByteReader(copy)) {
        #expect(segment.payload.lowerBound >= 4 && segment.payload.upperBound <= copy.count)
      }
    }
  }
}

import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct PhotoMetadataTests {
  private func metadata(_ fields: ExifFields) throws -> PhotoMetadata {
    let jpeg = try ImageCodec.encodeJPEG(
      RasterImage(width: 16, height: 16, channels: 3, filledWith: 90), quality: 0.5)
    return PhotoMetadata(ExifWriter.jpeg(jpeg, with: fields))
  }

  @Test func fieldsAreRead() throws {
    var fields = ExifFields()
    fields.orientation = 6
    fields.make = "Maker"
    fields.model = "Model 7"
    fields.focalLength = (414, 10)
    fields.focalLengthIn35mmFilm = 41
    fields.focalPlaneResolution = (25400, 10)
    fields.originalSize = (4000, 3000)
    fields.position = (-33.8568, 151.2153, -12.5)
    let read = try metadata(fields)
    #expect(read.orientation == 6)
    #expect(read.make == "Maker")
    #expect(read.model == "Model 7")
    #expect(read.focalLength == 41.4)
    #expect(read.focalLengthIn35mmFilm == 41)
    #expect(abs(try #require(read.focalPlaneResolution) - 100) < 1e-9)
    #expect(read.originalWidth == 4000)
    #expect(read.originalHeight == 3000)
    let position = try #require(read.position)
    #expect(abs(position.latitudeDegrees + 33.8568) < 1e-6)
    #expect(abs(position.longitudeDegrees - 151.2153) < 1e-6)
    #expect(position.altitude == -12.5)
  }

  @Test func implausibleValuesAreNil() throws {
    var fields = ExifFields()
    fields.orientation = 9
    fields.focalLength = (50, 0)
    fields.focalLengthIn35mmFilm = 0
    fields.focalPlaneResolution = (0, 0)
    fields.position = (95, 10, 0)
    let read = try metadata(fields)
    #expect(read == PhotoMetadata())
  }

  @Test func truncatedAndCorruptedDataDoesNotCrash() throws {
    var fields = ExifFields()
    fields.make = "Maker"
    fields.focalLength = (50, 1)
    fields.position = (10, 20, 30)
    let tiff = ExifWriter.tiff(fields)
    func expectValidOrientation(_ bytes: [UInt8]) {
      #expect((1...8).contains(PhotoMetadata(bytes).orientation))
    }
    for count in 0..<tiff.count { expectValidOrientation(Array(tiff.prefix(count))) }
    for index in tiff.indices {
      for value: UInt8 in [0, 1, 0x7F, 0x80, 0xFF] {
        var hostile = tiff
        hostile[index] = value
        expectValidOrientation(hostile)
      }
    }
    #expect(PhotoMetadata([]) == PhotoMetadata())
  }

  @Test func exifOfPNGIsRead() throws {
    var fields = ExifFields()
    fields.focalLengthIn35mmFilm = 28
    let png = try ImageCodec.encodePNG(RasterImage(width: 4, height: 4, channels: 3))
    let tiff = ExifWriter.tiff(fields)
    // After the signature and the header chunk; the reader doesn't verify checksums.
    let chunk = bigEndian(tiff.count) + Array("eXIf".utf8) + tiff + [0, 0, 0, 0]
    let read = PhotoMetadata(Array(png.prefix(33)) + chunk + Array(png.dropFirst(33)))
    #expect(read.focalLengthIn35mmFilm == 28)
  }

  @Test func heicDecodersApplyTheOrientation() throws {
    var fields = ExifFields()
    fields.orientation = 6
    fields.focalLengthIn35mmFilm = 26
    var content = ImageCodec.HEICContent()
    content.orientation = 6
    content.exif = ExifWriter.tiff(fields)
    let heic = try ImageCodec.encodeHEIC(RasterImage(width: 96, height: 64, channels: 3), content)
    let read = PhotoMetadata(heic)
    #expect(read.orientation == 1 && read.focalLengthIn35mmFilm == 26)
    #expect(try ImageCodec.decode(heic).width == 64)
  }
}

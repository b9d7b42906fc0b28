import ImageFiles
import SceneModel
import TestSupport
import Testing

/// Files with several JPEG images (CIPA DC-007), as stereo cameras and phones write them: the first
/// one is the photo.
@Suite struct MultiPictureTests {
  /// A file with the two images and the index of their places.
  private func file(_ first: RasterImage, _ second: RasterImage) throws -> [UInt8] {
    var fields = ExifFields()
    fields.model = "First"
    let photo = ExifWriter.jpeg(try ImageCodec.encodeJPEG(first, quality: 0.9), with: fields)
    fields.model = "Second"
    let other = ExifWriter.jpeg(try ImageCodec.encodeJPEG(second, quality: 0.9), with: fields)
    func field(_ tag: Int, _ type: Int, _ count: Int, _ value: [UInt8]) -> [UInt8] {
      bigEndian(tag, 2) + bigEndian(type, 2) + bigEndian(count) + value
    }
    let size = 4 + 8 + 2 + 3 * 12 + 4 + 32
    let entries =
      bigEndian(0x2003_0000) + bigEndian(photo.count + size + 4) + bigEndian(0) + bigEndian(0)
      + bigEndian(0x0002_0002) + bigEndian(other.count)
      // Relative to the structure inside the segment.
      + bigEndian(photo.count + size + 4 - 10) + bigEndian(0)
    let index =
      Array("MPF\0MM".utf8) + bigEndian(42, 2) + bigEndian(8) + bigEndian(3, 2)
      + field(0xB000, 7, 4, Array("0100".utf8)) + field(0xB001, 4, 1, bigEndian(2))
      + field(0xB002, 7, 32, bigEndian(50)) + bigEndian(0) + entries
    let segment = [0xFF, 0xE2] + bigEndian(index.count + 2, 2) + index
    return Array(photo.prefix(2)) + segment + photo.dropFirst(2) + other
  }

  @Test func theFirstPictureIsThePhoto() throws {
    let first = TexturePattern.image(width: 96, height: 64, seed: 1)
    let second = TexturePattern.image(width: 48, height: 32, seed: 2)
    let bytes = try file(first, second)
    #expect(try ImageHeader(bytes) == ImageHeader(format: .jpeg, width: 96, height: 64))
    let alone = try ImageCodec.decode(ImageCodec.encodeJPEG(first, quality: 0.9))
    #expect(try ImageCodec.decode(bytes) == alone)
    let half = try ImageCodec.decode(bytes, reducedBy: 2)
    #expect((half.width, half.height) == (48, 32))
    #expect(PhotoMetadata(bytes).model == "First")
  }

  /// Damage to the other picture doesn't matter.
  @Test func theOthersAreNotRead() throws {
    let image = TexturePattern.image(width: 96, height: 64, seed: 1)
    let bytes = try file(image, image)
    let alone = try ImageCodec.decode(ImageCodec.encodeJPEG(image, quality: 0.9))
    #expect(try ImageCodec.decode(Array(bytes.dropLast(100))) == alone)
  }
}

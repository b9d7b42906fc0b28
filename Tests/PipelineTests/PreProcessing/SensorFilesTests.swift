import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SensorFilesTests {
  /// A photo as a phone writes it: HEIC, with the orientation in its `irot` box and in EXIF.
  private func heic(orientation: Int, seed: UInt32) throws -> [UInt8] {
    var fields = ExifFields()
    fields.orientation = orientation
    var content = ImageCodec.HEICContent()
    content.orientation = orientation
    content.exif = ExifWriter.tiff(fields)
    return try ImageCodec.encodeHEIC(
      TexturePattern.image(width: 400, height: 320, seed: seed), content)
  }

  @Test(.endToEnd) func readingsBelongToTheirPhotos() throws {
    let folder = try TemporaryFolder()
    try folder.write(heic(orientation: 6, seed: 1), as: "IMG_1.HEIC")
    try folder.write("0.0,-1.0,0.0", as: "IMG_1_gravity.TXT")
    let depths = TIFFWriter.numbers(width: 3, height: 2, [1, 2, 3, 4, 5, 6])
    try folder.write(depths, as: "IMG_1_depth.TIF")
    try folder.write(heic(orientation: 1, seed: 2), as: "IMG_2.HEIC")
    try folder.write("up\n", as: "IMG_2_gravity.TXT")
    try folder.write("none", as: "IMG_2_depth.TIF")
    try folder.write(heic(orientation: 1, seed: 3), as: "IMG_3.HEIC")
    try folder.write(
      ImageCodec.encodePNG(RasterImage(width: 3, height: 2, channels: 3)), as: "IMG_3_depth.TIF")
    try folder.write("0,0,-1", as: "other_gravity.txt")

    let notes = StageNotes()
    let result = try PhotoIngestion().run(folder: folder.url, StageContext(notes: notes))
    #expect(result.photos.map(\.name) == ["IMG_1.HEIC", "IMG_2.HEIC", "IMG_3.HEIC"])
    #expect(result.photos[0].orientation == 1 && result.photos[0].width == 320)
    // A reading without a photo is treated like any other file.
    #expect(result.rejected.map(\.name) == ["other_gravity.txt"])
    #expect(Array(result.readings.keys) == [result.photos[0].sampleID])
    let reading = try #require(result.readings[result.photos[0].sampleID])
    #expect(reading.gravity == [0, 1, 0])
    let depth = try #require(reading.depth)
    #expect((depth.width, depth.height) == (2, 3) && depth.mayBeDisparities)
    #expect(depth.depths == [4, 1, 5, 2, 6, 3])
    for name in ["IMG_2_gravity.TXT", "IMG_2_depth.TIF", "IMG_3_depth.TIF"] {
      #expect(notes.warnings.contains { $0.hasPrefix("\(name) is not used") }, "\(name)")
    }
    #expect(notes.warnings.count == 3)
    #expect(!notes.warnings.contains { $0.contains("JPEG") })
  }

  /// A photo of an upright phone that is tilted down, with a map of a plane at 2 m.
  private func heicWithReadings(seed: UInt32, accuracy: String = "absolute") throws -> [UInt8] {
    var content = ImageCodec.HEICContent()
    content.orientation = 6
    content.exif = AppleExifWriter.tiff(orientation: 6, acceleration: [-0.06, -0.87, -0.48])
    var description = DepthHEICWriter.Description()
    description.accuracy = accuracy
    let photo = TexturePattern.image(width: 400, height: 320, seed: seed)
    return try DepthHEICWriter.file(
      photo, samples: [UInt8](repeating: 64, count: 400 * 320), description, content)
  }

  @Test(.endToEnd) func readingsInsideAPhotoStandInForFiles() throws {
    let folder = try TemporaryFolder()
    try folder.write(heicWithReadings(seed: 1), as: "IMG_1.HEIC")
    try folder.write(heicWithReadings(seed: 2), as: "IMG_2.HEIC")
    try folder.write("0,-1,0", as: "IMG_2_gravity.txt")
    try folder.write(EXRWriter(width: 2, height: 1, ["Z": [1, 2]]).file, as: "IMG_2_depth.exr")
    try folder.write(heicWithReadings(seed: 3, accuracy: "relative"), as: "IMG_3.HEIC")
    try folder.write("down", as: "IMG_3_gravity.txt")
    let notes = StageNotes()
    let result = try PhotoIngestion().run(folder: folder.url, StageContext(notes: notes))
    try #require(result.photos.count == 3)
    let readings = result.photos.map { result.readings[$0.sampleID] }
    let tilted = SIMD3(-0.06, 0.87, 0.48)
    for index in [0, 2] {
      let gravity = try #require(readings[index]?.gravity)
      #expect((gravity - tilted).length < 1e-4)
    }
    #expect(readings[1]?.gravity == [0, 1, 0])
    let depth = try #require(readings[0]?.depth?.depth(at: [0.5, 0.5]))
    #expect(abs(depth - 255 / 128) < 0.05 && readings[0]?.depth?.mayBeDisparities == false)
    #expect(readings[1]?.depth?.depths == [1, 2] && readings[2]?.depth == nil)
    #expect(notes.warnings.count == 1)
    #expect(notes.details.contains { $0.hasPrefix("The depth maps in 1 of 3 photos have no") })
  }

  @Test func accelerationOfAMovingPhoneIsNotGravity() throws {
    func gravity(_ acceleration: SIMD3<Double>, lens: String = "back") throws -> SIMD3<Double>? {
      let image = TexturePattern.image(width: 400, height: 320, seed: 1)
      let exif = AppleExifWriter.tiff(orientation: 1, acceleration: acceleration, lens: lens)
      let segment =
        [0xFF, 0xE1] + bigEndian(exif.count + 8, 2) + Array("Exif\0\0".utf8) + exif
      let jpeg = try ImageCodec.encodeJPEG(image, quality: 0.9)
      let folder = try TemporaryFolder()
      try folder.write(Array(jpeg.prefix(2)) + segment + jpeg.dropFirst(2), as: "a.jpg")
      let file = folder.url.appendingPathComponent("a.jpg")
      return try PhotoInspection().run(file, sampleID: 0).reading.gravity
    }
    let still = try #require(try gravity([-0.99337, -0.00907, -0.06566]))
    #expect((still - [0.00907, 0.99337, 0.06566]).length < 1e-4)
    #expect(try gravity([-0.5, 0, 0]) == nil)
    #expect(try gravity([-1.4, 0, 0]) == nil)
    #expect(try gravity([-1, 0, 0], lens: "iPhone front camera") == nil)
  }

  @Test func namesWithoutPhotosAreNotReadings() {
    let names = [
      "a_depth.tif", "b.jpg", "b_depth.jpg", "b_gravity.tif", "B_DEPTH.TIFF", "_depth.tif",
    ]
    let files = SensorFiles(names.map { URL(fileURLWithPath: "/photos/" + $0) })
    #expect(
      files.photos.map(\.lastPathComponent)
        == ["a_depth.tif", "b.jpg", "b_depth.jpg", "b_gravity.tif", "_depth.tif"])
  }
}

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

import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct PhotoIngestionTests {
  /// Sharp JPEGs of one scene that shifts slightly from photo to photo.
  private func photos(_ count: Int, step: Double = 3) throws -> [[UInt8]] {
    try (0..<count).map { index in
      try ImageCodec.encodeJPEG(
        TexturePattern.image(
          width: 420, height: 300, seed: 7, shift: [Double(index) * step, 0]),
        quality: 0.9)
    }
  }

  private func blurred(_ bytes: [UInt8]) throws -> [UInt8] {
    let image = try ImageCodec.decode(bytes)
    let small = try image.resized(width: image.width / 12, height: image.height / 12)
    return try ImageCodec.encodeJPEG(
      small.resized(width: image.width, height: image.height), quality: 0.9)
  }

  @Test func everyFileIsUsedOrReported() throws {
    let folder = try TemporaryFolder()
    let good = try photos(6)
    for (index, bytes) in good.enumerated() { try folder.write(bytes, as: "IMG_\(index + 7).jpg") }
    try folder.write(Array(good[1].prefix(good[1].count / 2)), as: "cut.jpg")
    try folder.write("hello\n", as: "notes.txt")
    try folder.write([], as: "empty.jpg")
    try folder.write(
      ImageCodec.encodePNG(TexturePattern.image(width: 100, height: 80, seed: 1)), as: "tiny.png")
    try folder.write(good[2], as: "copy.jpg")
    try folder.write(
      ImageCodec.encodeJPEG(ImageCodec.decode(good[3]), quality: 0.5), as: "recoded.jpg")
    try folder.write(blurred(photos(9)[8]), as: "soft.jpg")
    try folder.write(
      ImageCodec.encodePNG(RasterImage(width: 400, height: 300, channels: 3, filledWith: 30)),
      as: "dark.jpg")
    try folder.write(good[0], as: ".hidden.jpg")
    try folder.write(good[0], as: "deeper/other.jpg")

    let result = try PhotoIngestion().run(folder: folder.url, StageContext())
    let faults = Dictionary(uniqueKeysWithValues: result.rejected.map { ($0.name, $0.fault) })
    #expect(
      faults == [
        "cut.jpg": .unreadable, "notes.txt": .unsupportedFormat, "empty.jpg": .unreadable,
        "tiny.png": .tooSmall, "IMG_9.jpg": .duplicate, "recoded.jpg": .duplicate,
        "soft.jpg": .blurred, "dark.jpg": .blank,
      ])
    #expect(
      result.photos.map(\.name) == [
        "copy.jpg", "IMG_7.jpg", "IMG_8.jpg", "IMG_10.jpg", "IMG_11.jpg", "IMG_12.jpg",
      ])
    #expect(result.files.count == 14)
    for photo in result.photos { #expect(result.files[photo.sampleID] == photo.url) }
    for rejected in result.rejected {
      #expect(rejected.reason.hasPrefix(rejected.name))
      #expect(result.files[rejected.sampleID].lastPathComponent == rejected.name)
    }
    #expect(result.photos.map(\.id.index) == Array(0..<6))
    #expect(result.cameras.count == 1)
    #expect(!result.isDownsampled)
  }

  /// A raw file of the photo that `photos` makes with the same index.
  private func raw(_ index: Int) -> [UInt8] {
    let image = TexturePattern.image(
      width: 420, height: 300, seed: 7, shift: [Double(index) * 3, 0])
    return DNGWriter(width: 420, height: 300).file { column, row in
      let pixel = 3 * (row * 420 + column)
      return SIMD3(
        Double(image.pixels[pixel]), Double(image.pixels[pixel + 1]),
        Double(image.pixels[pixel + 2])) / 255
    }
  }

  @Test func rawFilesGiveWayToThePhotosOfTheirName() throws {
    let folder = try TemporaryFolder()
    let good = try photos(3)
    try folder.write(raw(0), as: "IMG_1.CR2")
    try folder.write(good[0], as: "img_1.jpg")
    try folder.write(raw(1), as: "IMG_2.DNG")
    try folder.write(Array(good[2].prefix(good[2].count / 2)), as: "IMG_2.JPG")
    try folder.write(raw(2), as: "IMG_3.NEF")
    let result = try PhotoIngestion().run(folder: folder.url, StageContext())
    #expect(result.photos.map(\.name) == ["img_1.jpg", "IMG_2.DNG", "IMG_3.NEF"])
    let reasons = Dictionary(uniqueKeysWithValues: result.rejected.map { ($0.name, $0) })
    #expect(reasons["IMG_1.CR2"]?.fault == .duplicate)
    #expect(
      reasons["IMG_1.CR2"]?.reason
        == "IMG_1.CR2 is not used: it is the raw file of img_1.jpg, which is used.")
    #expect(reasons["IMG_2.JPG"]?.fault == .unreadable && reasons.count == 2)
  }

  @Test func formatIsDetectedFromContent() throws {
    let folder = try TemporaryFolder()
    let image = TexturePattern.image(width: 400, height: 300, seed: 3)
    try folder.write(ImageCodec.encodePNG(image), as: "a.jpg")
    try folder.write(photos(1)[0], as: "b.png")
    try folder.write("not a picture", as: "c.jpg")
    let result = try PhotoIngestion().run(folder: folder.url, StageContext())
    #expect(result.photos.map(\.name) == ["a.jpg", "b.png"])
    #expect(result.rejected.map(\.fault) == [.unsupportedFormat])
  }

  /// The photos of a slow turntable differ little; all of them must be kept.
  @Test func consecutivePhotosAreNotDuplicates() throws {
    let folder = try TemporaryFolder()
    for (index, bytes) in try photos(12, step: 1.5).enumerated() {
      try folder.write(bytes, as: "\(index).jpg")
    }
    let result = try PhotoIngestion().run(folder: folder.url, StageContext())
    #expect(result.photos.count == 12)
  }

  @Test(arguments: 1...8) func orientationIsAppliedOnce(orientation: Int) throws {
    let folder = try TemporaryFolder()
    let upright = TexturePattern.image(width: 400, height: 320, seed: 5)
    let inverse = [6: 8, 8: 6][orientation] ?? orientation
    var fields = ExifFields()
    fields.orientation = orientation
    let stored = try upright.turned(byOrientation: inverse)
    try folder.write(
      ExifWriter.jpeg(ImageCodec.encodeJPEG(stored, quality: 0.98), with: fields), as: "a.jpg")

    let result = try PhotoIngestion().run(folder: folder.url, StageContext())
    let photo = try #require(result.photos.first)
    #expect(photo.orientation == orientation)
    #expect((photo.width, photo.height) == (400, 320))
    #expect((result.cameras[0].width, result.cameras[0].height) == (400, 320))
    let image = try ImageStore(photos: result.photos).image(photo.id)
    let difference = zip(image.pixels, upright.pixels).map { abs(Int($0) - Int($1)) }.reduce(0, +)
    #expect(Double(difference) / Double(upright.pixels.count) < 8)
  }

  @Test func photosOfOneCameraShareIt() throws {
    let folder = try TemporaryFolder()
    var fields = ExifFields()
    fields.make = "Maker"
    fields.focalLengthIn35mmFilm = 36
    for (index, bytes) in try photos(4).enumerated() {
      if index == 2 { fields.focalLengthIn35mmFilm = 72 }
      try folder.write(
        index == 3 ? bytes : ExifWriter.jpeg(bytes, with: fields), as: "\(index).jpg")
    }
    let result = try PhotoIngestion().run(folder: folder.url, StageContext())
    #expect(result.photos.map(\.camera.index) == [0, 0, 1, 2])
    #expect(result.cameras.map(\.focalLength.x) == [420, 840, 504])
    #expect(result.cameras.map(\.calibration) == [.exif, .exif, .assumed])
  }

  @Test func excessPhotosAreRejected() throws {
    let folder = try TemporaryFolder()
    for (index, bytes) in try photos(5).enumerated() {
      try folder.write(bytes, as: "\(index).jpg")
    }
    try folder.write(
      ImageCodec.encodeJPEG(TexturePattern.image(width: 610, height: 300, seed: 2), quality: 0.9),
      as: "0wide.jpg")
    var options = PhotoIngestion.Options()
    options.maximumPhotos = 3
    options.inspection.limits.maximumSide = 600
    options.memoryBudget = 64 * 110_000
    let result = try PhotoIngestion(options).run(folder: folder.url, StageContext())
    #expect(result.photos.map(\.name) == ["0.jpg", "1.jpg", "2.jpg"])
    #expect(result.rejected.map(\.fault) == [.tooLarge, .tooMany, .tooMany])
    #expect(result.isDownsampled)
    let store = ImageStore(photos: result.photos, processingPixels: result.processingPixels)
    let image = try store.image(ID(0))
    #expect(image.width * image.height <= 110_000)
    #expect(image.width * image.height > 105_000)
  }

  @Test func threadsChangeNothing() throws {
    let folder = try TemporaryFolder()
    for (index, bytes) in try photos(5).enumerated() {
      try folder.write(bytes, as: "\(index).jpg")
    }
    let results = try [1, 2].map {
      try PhotoIngestion().run(
        folder: folder.url, StageContext(control: KernelControl(threadCount: $0)))
    }
    #expect(results[0].photos == results[1].photos)
    #expect(results[0].contentHashes == results[1].contentHashes)
    #expect(results[0].cameras == results[1].cameras)
  }

  @Test func cancellationStops() throws {
    let folder = try TemporaryFolder()
    try folder.write(photos(1)[0], as: "a.jpg")
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try PhotoIngestion().run(
        folder: folder.url, StageContext(control: KernelControl(flag: flag)))
    }
  }

  @Test func unreadableFoldersAreReported() throws {
    let folder = try TemporaryFolder()
    let file = try folder.write([1], as: "file")
    #expect(throws: PipelineError.self) {
      try PhotoIngestion().run(
        folder: folder.url.appendingPathComponent("missing"), StageContext())
    }
    #expect(throws: PipelineError.self) { try PhotoIngestion().run(folder: file, StageContext()) }
    try FileManager.default.removeItem(at: file)
    #expect(try PhotoIngestion().run(folder: folder.url, StageContext()).files.isEmpty)
  }

  @Test func namesSortNaturally() {
    let sorted = ["b1", "a10.jpg", "a2.jpg", "a02.jpg", "A1.jpg", "a.jpg", "a1x", "10", "9"]
      .sorted { NaturalSortKey($0) < NaturalSortKey($1) }
    #expect(sorted == ["9", "10", "a.jpg", "A1.jpg", "a1x", "a02.jpg", "a2.jpg", "a10.jpg", "b1"])
  }
}

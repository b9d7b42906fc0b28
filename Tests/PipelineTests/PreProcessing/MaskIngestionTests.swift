import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MaskIngestionTests {
  private static let (width, height) = (400, 320)

  private func photo(_ number: Int = 0) -> RasterImage {
    TexturePattern.image(
      width: Self.width, height: Self.height, seed: 5, shift: [40 * Double(number), 0])
  }

  /// Marks a rectangle that no rotation or reflection maps onto itself.
  private func mask(width: Int = width, height: Int = height, value: UInt8 = 255) -> RasterImage {
    var mask = RasterImage(width: width, height: height, channels: 1)
    for y in height / 8..<height / 2 {
      for x in width / 10..<width / 4 { mask.pixels[y * width + x] = value }
    }
    return mask
  }

  private func store(_ ingested: IngestedPhotos) -> ImageStore {
    ImageStore(
      photos: ingested.photos, processingPixels: ingested.processingPixels,
      contentHashes: ingested.contentHashes)
  }

  /// Fraction of the pixels in which two masks differ.
  private func difference(_ a: RasterImage?, _ b: RasterImage) throws -> Double {
    let a = try #require(a)
    #expect((a.width, a.height, a.channels) == (b.width, b.height, 1))
    let count = zip(a.pixels, b.pixels).count { ($0 >= 128) != ($1 >= 128) }
    return Double(count) / Double(b.pixels.count)
  }

  private func ingest(
    _ folder: TemporaryFolder, usesMasks: Bool = true, masks: String? = nil,
    notes: StageNotes = StageNotes()
  ) throws -> IngestedPhotos {
    var options = PhotoIngestion.Options()
    options.inspection.usesMasks = usesMasks
    options.maskFolder = masks.map { folder.url.appendingPathComponent($0) }
    return try PhotoIngestion(options).run(folder: folder.url, StageContext(notes: notes))
  }

  /// One photo per case, so that the reasons can be distinguished.
  @Test func masksAreUsedOrReported() throws {
    let folder = try TemporaryFolder()
    for number in 0..<7 {
      try folder.write(ImageCodec.encodePNG(photo(number)), as: "\(number).png")
    }
    try folder.write(ImageCodec.encodePNG(mask()), as: "0_mask.png")
    try folder.write(ImageCodec.encodePNG(mask(width: 100, height: 80, value: 1)), as: "1_mask.png")
    try folder.write(ImageCodec.encodePNG(mask(width: 320, height: 320)), as: "2_mask.png")
    try folder.write(ImageCodec.encodePNG(mask(value: 0)), as: "3_mask.png")
    try folder.write("no image", as: "4_mask.png")
    try folder.write(
      ImageCodec.encodeJPEG(mask(width: 800, height: 640), quality: 0.5), as: "5_mask.jpg")
    try folder.write(ImageCodec.encodePNG(mask()), as: "9_mask.png")

    let notes = StageNotes()
    let result = try ingest(folder, notes: notes)
    #expect(result.photos.map(\.name) == (0..<7).map { "\($0).png" })
    #expect(result.rejected.isEmpty)
    #expect(result.files.count == 7)
    #expect(result.photos.map { $0.mask != nil } == [true, true, false, false, false, true, false])
    let reasons = result.rejectedMasks.map(\.reason)
    #expect(reasons.count == 4)
    #expect(reasons[0].hasPrefix("2_mask.png") && reasons[0].contains("320 × 320"))
    #expect(reasons[1].hasPrefix("3_mask.png") && reasons[1].contains("no pixel"))
    #expect(reasons[2].hasPrefix("4_mask.png") && reasons[2].contains("text file"))
    #expect(reasons[3].hasPrefix("9_mask.png") && reasons[3].contains("without a photo"))
    #expect(notes.counts["masks"] == 3 && notes.counts["refusedMasks"] == 4)
    #expect(notes.warnings == reasons)

    let images = store(result)
    #expect(try difference(images.mask(ID(0)), mask()) == 0)
    #expect(try difference(images.mask(ID(1)), mask()) < 0.01)
    #expect(try difference(images.mask(ID(5)), mask()) < 0.01)
    #expect(try images.mask(ID(6)) == nil)
    let small = try #require(try images.mask(ID(0), maximumPixels: 20_000))
    let reduced = try images.image(ID(0), maximumPixels: 20_000)
    #expect((small.width, small.height) == (reduced.width, reduced.height))
    let coverage = try #require(result.photos[0].mask?.coverage)
    #expect(abs(coverage - 0.15 * 0.375) < 0.002)
  }

  /// With masking disabled, masks are not read and don't count as photos either.
  @Test func masksMayBeIgnored() throws {
    let folder = try TemporaryFolder()
    try folder.write(ImageCodec.encodePNG(photo()), as: "a.png")
    try folder.write(ImageCodec.encodePNG(mask()), as: "a_mask.png")
    try folder.write("no image", as: "masks/a.png")
    let result = try ingest(folder, usesMasks: false)
    #expect(result.photos.map(\.name) == ["a.png"])
    #expect(result.photos[0].mask == nil)
    #expect(result.rejected.isEmpty && result.rejectedMasks.isEmpty)
  }

  @Test func foldersTakePrecedenceOverFilesAndAlpha() throws {
    let folder = try TemporaryFolder()
    var cut = RasterImage(width: Self.width, height: Self.height, channels: 4, filledWith: 0)
    let colors = photo()
    for pixel in 0..<Self.width * Self.height {
      for channel in 0..<3 { cut.pixels[4 * pixel + channel] = colors.pixels[3 * pixel + channel] }
      // A faint remainder of what was cut away.
      cut.pixels[4 * pixel + 3] = pixel % Self.width < 100 ? 255 : 20
    }
    try folder.write(ImageCodec.encodePNG(cut), as: "a.png")
    let alpha = try ingest(folder)
    let left = try #require(alpha.photos[0].mask)
    #expect(left.file == nil && abs(left.coverage - 0.25) < 1e-9)
    #expect(try store(alpha).mask(ID(0))?.pixels.prefix(Self.width).count { $0 == 255 } == 100)

    let names = ["a_mask.png", "masks/a.png.png", "elsewhere/a.png"]
    for (index, name) in names.enumerated() {
      let side = 4 << index
      var mark = RasterImage(width: Self.width, height: Self.height, channels: 1)
      for y in 0..<side { for x in 0..<side { mark.pixels[y * Self.width + x] = 255 } }
      try folder.write(ImageCodec.encodePNG(mark), as: name)
      let result = try ingest(folder, masks: index == 2 ? "elsewhere" : nil)
      let coverage = try #require(result.photos[0].mask?.coverage)
      #expect((coverage * Double(Self.width * Self.height)).rounded() == Double(side * side))
    }
  }

  @Test func opaquePhotosHaveNoMask() throws {
    let folder = try TemporaryFolder()
    var opaque = RasterImage(width: Self.width, height: Self.height, channels: 4, filledWith: 255)
    var clear = opaque
    let colors = photo()
    for pixel in 0..<Self.width * Self.height {
      for channel in 0..<3 {
        opaque.pixels[4 * pixel + channel] = colors.pixels[3 * pixel + channel]
        clear.pixels[4 * pixel + channel] = 255 - colors.pixels[3 * pixel + channel]
      }
      clear.pixels[4 * pixel + 3] = 0
    }
    try folder.write(ImageCodec.encodePNG(opaque), as: "a.png")
    try folder.write(ImageCodec.encodePNG(clear), as: "b.png")
    let result = try ingest(folder)
    #expect(result.photos.map { $0.mask == nil } == [true, true])
    #expect(result.rejectedMasks.count == 1)
    #expect(result.rejectedMasks[0].reason.contains("b.png"))
  }

  /// Writes a photo in stored orientation, and its mask in upright or in stored orientation.
  private func write(
    _ number: Int, _ orientation: Int, maskAsStored: Bool, to folder: TemporaryFolder
  ) throws {
    let inverse = [6: 8, 8: 6][orientation] ?? orientation
    var fields = ExifFields()
    fields.orientation = orientation
    let stored = try photo(number).turned(byOrientation: inverse)
    try folder.write(
      ExifWriter.jpeg(ImageCodec.encodeJPEG(stored, quality: 0.98), with: fields),
      as: "\(number).jpg")
    let shown = maskAsStored ? try mask().turned(byOrientation: inverse) : mask()
    try folder.write(ImageCodec.encodePNG(shown), as: "\(number)_mask.png")
  }

  /// Photos in portrait orientation determine the orientation of all masks, including those of
  /// upside-down photos.
  @Test(arguments: [false, true]) func orientationFollowsTheSet(maskAsStored: Bool) throws {
    let folder = try TemporaryFolder()
    for orientation in 1...8 {
      try write(orientation, orientation, maskAsStored: maskAsStored, to: folder)
    }
    let result = try ingest(folder)
    #expect(result.photos.count == 8 && result.rejectedMasks.isEmpty)
    let images = store(result)
    for photo in result.photos {
      #expect(try difference(images.mask(photo.id), mask()) == 0, "\(photo.name)")
    }
  }

  /// A mask with EXIF data is rotated accordingly.
  @Test func masksMayHaveAnOrientation() throws {
    let folder = try TemporaryFolder()
    try folder.write(ImageCodec.encodePNG(photo()), as: "a.png")
    var fields = ExifFields()
    fields.orientation = 3
    let turned = try mask().turned(byOrientation: 3)
    try folder.write(
      ExifWriter.jpeg(ImageCodec.encodeJPEG(turned, quality: 0.9), with: fields), as: "a_mask.jpg")
    let result = try ingest(folder)
    #expect(try difference(store(result).mask(ID(0)), mask()) < 0.01)
  }

  @Test func fingerprintsCoverMasks() throws {
    let folder = try TemporaryFolder()
    try folder.write(ImageCodec.encodePNG(photo()), as: "a.png")
    var values: Set<UInt64> = [try store(ingest(folder)).fingerprint(of: ID(0))]
    for value: UInt8 in [200, 255] {
      try folder.write(ImageCodec.encodePNG(mask(value: value)), as: "a_mask.png")
      values.insert(try store(ingest(folder)).fingerprint(of: ID(0)))
    }
    #expect(values.count == 3)
    #expect(values.contains(try store(ingest(folder, usesMasks: false)).fingerprint(of: ID(0))))
  }
}

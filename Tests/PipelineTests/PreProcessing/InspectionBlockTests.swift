import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

/// What one process found in files, as another reads it.
@Suite struct InspectionBlockTests {
  /// A folder of three photos and a file that isn't one.
  private func folder() throws -> TemporaryFolder {
    let folder = try TemporaryFolder()
    for index in 0..<3 {
      let image = TexturePattern.image(
        width: 420, height: 300, seed: 7, shift: [Double(index) * 5, 0])
      try folder.write(ImageCodec.encodeJPEG(image, quality: 0.9), as: "IMG_\(index).jpg")
    }
    try folder.write("no photo", as: "IMG_1b.jpg")
    return folder
  }

  private func block(in folder: TemporaryFolder) throws -> InspectionBlock {
    let files = try PhotoFolder.files(in: folder.url)
    return try FileInspection(files, MaskFiles(files: files, maskFiles: []), .init())
      .run(files.indices, KernelControl(threadCount: 2))
  }

  @Test func blocksAreReadAsWritten() throws {
    let block = try block(in: try folder())
    let data = try block.unitData()
    let read = try #require(InspectionBlock(unit: data))
    #expect(try read.unitData() == data)
    #expect(read.results.count == 4)
    for (found, expected) in zip(read.results, block.results) {
      switch (found, expected) {
      case (.success(let photo), .success(let original)):
        #expect(photo.thumbnail == original.thumbnail)
        #expect(photo.metadata == original.metadata)
        #expect(photo.sharpness == original.sharpness)
        #expect(photo.contentHash == original.contentHash)
      case (.failure(let rejection), .failure(let original)):
        #expect(rejection.photo == original.photo)
      default: Issue.record("a photo became a rejection, or the reverse")
      }
    }
  }

  @Test func damagedBlocksCountAsMissing() throws {
    let data = try block(in: try folder()).unitData()
    for count in [0, 4, 8, 100, data.count - 1] {
      #expect(InspectionBlock(unit: Data(data.prefix(count))) == nil)
    }
    #expect(InspectionBlock(unit: data + [0]) == nil)
  }

  /// The blocks that other processes made are used instead of the files.
  @Test func blocksOfOtherProcessesAreUsed() throws {
    let (photos, work) = (try folder(), try TemporaryFolder())
    let expected = try PhotoIngestion().run(folder: photos.url, StageContext())
    let units = InspectionUnits(UnitStore(folder: work.url, isWritten: true), folderKey: 1)
    for index in 0..<2 {
      try PhotoIngestion().inspect(
        Block(index: index, of: 2), in: photos.url, for: units, StageContext())
    }
    try photos.write("damaged", as: "IMG_2.jpg")
    var ingestion = PhotoIngestion()
    ingestion.units = units
    let found = try ingestion.run(folder: photos.url, StageContext())
    #expect(try Fingerprint.content(of: found) == Fingerprint.content(of: expected))
    ingestion.units = InspectionUnits(
      UnitStore(folder: work.url, isWritten: true), folderKey: 2)
    #expect(try ingestion.run(folder: photos.url, StageContext()).photos.count == 2)
  }
}

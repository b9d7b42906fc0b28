import Foundation
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MaskFilesTests {
  private func urls(_ names: [String]) -> [URL] { names.map { URL(fileURLWithPath: "/set/" + $0) } }

  private func pairs(_ files: MaskFiles) -> [String: String] {
    Dictionary(
      uniqueKeysWithValues: files.photos.compactMap { photo in
        files.mask(of: photo).map { (photo.lastPathComponent, $0.lastPathComponent) }
      })
  }

  @Test func masksNextToPhotosAreNotPhotos() {
    let files = MaskFiles(
      files: urls([
        "A.JPG", "a_mask.png", "b.png", "b.mask.PNG", "c.tif", "c.tif.mask.tif", "d.jpg",
        "e_MASK.jpg",
        "notes_mask.txt", "masks.jpg",
      ]), maskFiles: [])
    #expect(
      files.photos.map(\.lastPathComponent) == [
        "A.JPG", "b.png", "c.tif", "d.jpg", "notes_mask.txt", "masks.jpg",
      ])
    #expect(
      pairs(files) == ["A.JPG": "a_mask.png", "b.png": "b.mask.PNG", "c.tif": "c.tif.mask.tif"])
    #expect(files.masksWithoutPhoto.map(\.lastPathComponent) == ["e_MASK.jpg"])
  }

  /// Without a matching photo the name is no evidence: photos may depict masks.
  @Test func photosOfMasksAreKept() {
    let names = ["african_mask.jpg", "golden_mask.jpg", "_mask.jpg"]
    let files = MaskFiles(files: urls(names), maskFiles: [])
    #expect(files.photos.map(\.lastPathComponent) == names)
    #expect(files.masksWithoutPhoto.isEmpty)
  }

  @Test func maskFoldersAcceptMoreNames() {
    let files = MaskFiles(
      files: urls(["a.jpg", "b.jpg", "c.jpg", "d.jpg", "e.jpg", "e_mask.png"]),
      maskFiles: urls([
        "m/a.jpg.png", "m/b.png", "m/c_mask.png", "m/d.jpg.mask.png", "m/e.png", "m/f.png",
        "m/readme.md",
      ]))
    #expect(
      pairs(files) == [
        "a.jpg": "a.jpg.png", "b.jpg": "b.png", "c.jpg": "c_mask.png", "d.jpg": "d.jpg.mask.png",
        "e.jpg": "e.png",
      ])
    #expect(files.photos.count == 5)
    #expect(files.masksWithoutPhoto.map(\.lastPathComponent) == ["f.png"])
  }

  @Test func photoFolderIsNotAMaskFolder() throws {
    try withTemporaryFolder { folder in
      try Data([1]).write(to: folder.appendingPathComponent("a.png"))
      let files = try MaskFiles(folder: folder, maskFolder: folder)
      #expect(files.photos.count == 1)
      #expect(pairs(files).isEmpty)
    }
  }
}

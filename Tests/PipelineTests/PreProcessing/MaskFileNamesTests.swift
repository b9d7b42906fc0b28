import Foundation
import Testing

@testable import Pipeline

@Suite struct MaskFileNamesTests {
  @Test func masksAreNamedLikeTheirPhotos() {
    #expect(MaskFiles.names(forMasksOf: []).isEmpty)
    #expect(
      MaskFiles.names(forMasksOf: ["IMG_1.jpg", "IMG_2.HEIC", "a.b.png"]) == [
        "IMG_1.png", "IMG_2.png", "a.b.png",
      ])
  }

  @Test func photosOfOneNameHaveDifferentMasks() {
    #expect(
      MaskFiles.names(forMasksOf: ["IMG_1.jpg", "img_1.HEIC", "IMG_2.jpg"]) == [
        "IMG_1.jpg.png", "img_1.HEIC.png", "IMG_2.png",
      ])
  }

  /// Masks that were written are found when they are given.
  @Test func namesAreThoseOfMasksInAFolder() {
    let photos = ["a.jpg", "A.png", "b.tif", "c.d.jpg"]
    let names = MaskFiles.names(forMasksOf: photos)
    #expect(Set(names.map { $0.lowercased() }).count == photos.count)
    let files = MaskFiles(
      files: photos.map { URL(fileURLWithPath: "/set/" + $0) },
      maskFiles: names.map { URL(fileURLWithPath: "/set/masks/" + $0) })
    #expect(files.photos.count == photos.count && files.masksWithoutPhoto.isEmpty)
    #expect(files.photos.map { files.mask(of: $0)?.lastPathComponent } == names)
  }
}

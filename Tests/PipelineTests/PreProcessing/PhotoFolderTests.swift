import Foundation
import Pipeline
import TestFiles
import Testing

@Suite struct PhotoFolderTests {
  private func names(_ folder: URL) throws -> [String] {
    try PhotoFolder.files(in: folder).map(\.lastPathComponent)
  }

  @Test func filesAreInNaturalOrder() throws {
    let folder = try TemporaryFolder()
    for name in ["IMG_10.jpg", "img_2.jpg", "IMG_1.jpg", ".hidden.jpg", "inner/IMG_3.jpg"] {
      let file = folder.url.appendingPathComponent(name)
      try FileManager.default.createDirectory(
        at: file.deletingLastPathComponent(), withIntermediateDirectories: true)
      try Data([1]).write(to: file)
    }
    #expect(try names(folder.url) == ["IMG_1.jpg", "img_2.jpg", "IMG_10.jpg"])
  }

  @Test func symbolicLinksAreFollowed() throws {
    let folder = try TemporaryFolder()
    let (photos, links) = (
      folder.url.appendingPathComponent("photos"), folder.url.appendingPathComponent("links")
    )
    for each in [photos, links] {
      try FileManager.default.createDirectory(at: each, withIntermediateDirectories: true)
    }
    try Data([1]).write(to: photos.appendingPathComponent("IMG_1.jpg"))
    let link = links.appendingPathComponent("IMG_2.jpg")
    try FileManager.default.createSymbolicLink(
      at: link, withDestinationURL: photos.appendingPathComponent("IMG_1.jpg"))
    try FileManager.default.createSymbolicLink(
      at: links.appendingPathComponent("IMG_3.jpg"),
      withDestinationURL: photos.appendingPathComponent("missing.jpg"))
    #expect(try names(links) == ["IMG_2.jpg"])
    let folderLink = folder.url.appendingPathComponent("folder")
    try FileManager.default.createSymbolicLink(at: folderLink, withDestinationURL: links)
    let found = try PhotoFolder.files(in: folderLink)
    #expect(found == [folderLink.appendingPathComponent("IMG_2.jpg")])
  }

  @Test func unreadableFoldersAreErrors() throws {
    let folder = try TemporaryFolder()
    let file = folder.url.appendingPathComponent("file")
    try Data([1]).write(to: file)
    for url in [file, folder.url.appendingPathComponent("missing")] {
      #expect(throws: PipelineError.self) { try PhotoFolder.files(in: url) }
    }
  }
}

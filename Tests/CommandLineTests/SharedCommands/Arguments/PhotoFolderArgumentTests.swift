import Foundation
import TestSupport
import Testing

@testable import SharedCommands

@Suite struct PhotoFolderArgumentTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var path: String { temporary.url.path }

  private func failure(_ name: String, holding content: String = "photos") -> CommandFailure? {
    #expect(throws: CommandFailure.self, "\(name)") {
      try PhotoFolderArgument(name, holding: content)
    }
  }

  @Test func foldersWithFilesAreAccepted() throws {
    try temporary.write([0], as: "photos/a.jpg")
    let folder = try PhotoFolderArgument(path + "/photos")
    #expect(folder.url == URL(fileURLWithPath: path + "/photos", isDirectory: true))
    #expect(try PhotoFolderArgument(path + "/photos/").url == folder.url)
  }

  @Test func missingFoldersAreInvalidArguments() {
    let failure = failure(path + "/none")
    #expect(failure?.exitCode == 2 && failure?.sentence.contains("does not exist") == true)
  }

  @Test func filesAreInvalidArguments() throws {
    try temporary.write([0], as: "photos/a.jpg")
    let failure = failure(path + "/photos/a.jpg")
    #expect(failure?.exitCode == 2)
    #expect(failure?.sentence.hasSuffix("holds the photos: \(path)/photos") == true)
    let mask = self.failure(path + "/photos/a.jpg", holding: "masks")
    #expect(mask?.sentence.contains("holds the masks") == true)
  }

  /// Hidden files do not count as content. A folder without photos fails the run; one without masks
  /// is an invalid argument.
  @Test func emptyFoldersFail() throws {
    try temporary.write([0], as: "empty/.DS_Store")
    let photos = failure(path + "/empty")
    #expect(photos?.exitCode == 1 && photos?.sentence.contains("JPEG, HEIC or PNG") == true)
    let masks = failure(path + "/empty", holding: "masks")
    #expect(masks?.exitCode == 2 && masks?.sentence.contains("should hold the masks") == true)
  }
}

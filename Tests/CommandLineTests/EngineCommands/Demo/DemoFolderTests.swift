import Foundation
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct DemoFolderTests {
  private let temporary: TemporaryFolder
  private let folder: DemoFolder

  init() throws {
    temporary = try TemporaryFolder()
    folder = DemoFolder(temporary.url.appendingPathComponent("demo").path)
  }

  private func refusal() -> String? {
    do {
      try folder.create(photoCount: 3)
      return nil
    } catch {
      let failure = CommandFailure(error)
      #expect(failure.exitCode == CommandFailure.usageCode)
      return failure.sentence
    }
  }

  @Test func pathsAreInTheFolder() {
    #expect(DemoFolder("a/b//").model == "a/b/model.usdz")
    #expect(DemoFolder("x").photos == "x/photos" && DemoFolder(".").picture == "./model.png")
    #expect(DemoFolder.photoName(3) == "demo_03.jpg" && DemoFolder.photoName(12) == "demo_12.jpg")
  }

  @Test func anEarlierDemoIsReplaced() throws {
    #expect(refusal() == nil)
    try temporary.write("x", as: "demo/photos/demo_02.jpg")
    try temporary.write("x", as: "demo/model.usdz")
    try temporary.write("x", as: "demo/model.png")
    #expect(refusal() == nil)
  }

  @Test(arguments: [
    "photos/demo_03.jpg", "photos/IMG_1.jpg", "notes.txt", "model.usdz", ".hidden", "model.png",
  ])
  func otherFilesAreKept(_ name: String) throws {
    try temporary.write("mine", as: "demo/\(name)")
    #expect(refusal()?.contains("holds \(name)") == true)
    let file = temporary.url.appendingPathComponent("demo/\(name)")
    #expect(try String(contentsOf: file, encoding: .utf8) == "mine")
  }

  @Test func filesAreNoFolders() throws {
    try temporary.write("mine", as: "demo")
    #expect(refusal()?.contains("is a file") == true)
  }

  @Test func photosMayNotBeAFile() throws {
    try temporary.write("mine", as: "demo/photos")
    #expect(refusal()?.contains("photos is a file") == true)
  }

  @Test func foldersThatCanNotBeCreatedAreRefused() {
    for path in ["", "/proc/none/demo"] {
      #expect(throws: CommandFailure.self) { try DemoFolder(path).create(photoCount: 3) }
    }
  }
}

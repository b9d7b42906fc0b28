import Foundation
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct RunArgumentsTests {
  @Test func threadsDefaultToTheProcessors() throws {
    #expect(
      try ThreadArguments.parse([]).threadCount == ProcessInfo.processInfo.activeProcessorCount)
    #expect(try ThreadArguments.parse(["--threads", "3"]).threadCount == 3)
    for count in ["0", "1025", "x"] {
      #expect(throws: (any Error).self) { try ThreadArguments.parse(["--threads", count]) }
    }
  }

  @Test func outputsNeedAnExistingFolder() throws {
    let temporary = try TemporaryFolder()
    let path = temporary.url.path
    #expect(try RunArguments.parse([]).reportFile() == nil)
    #expect(
      try RunArguments.parse(["--report", path + "/r.json"]).reportFile()?.url.lastPathComponent
        == "r.json")
    let failure = #expect(throws: CommandFailure.self) {
      try RunArguments.parse(["--report", path + "/none/r.json"]).reportFile()
    }
    #expect(failure?.exitCode == 2)
  }

  @Test func previewsArePNGFiles() throws {
    #expect(try PreviewArguments.parse([]).file() == nil)
    #expect(try PreviewArguments.parse(["--preview", "/a.PNG"]).file()?.path == "/a.PNG")
    let failure = #expect(throws: CommandFailure.self) {
      try PreviewArguments.parse(["--preview", "/a.jpg"]).file()
    }
    #expect(failure?.exitCode == 2 && failure?.sentence.contains(".png") == true)
  }

  @Test func masksAreAFolder() throws {
    let temporary = try TemporaryFolder()
    try temporary.write([0], as: "masks/a.png")
    #expect(try MaskArguments.parse([]).folder == nil)
    let masks = temporary.url.path + "/masks"
    #expect(try MaskArguments.parse(["--masks", masks]).folder?.path == masks)
    #expect(throws: CommandFailure.self) {
      try MaskArguments.parse(["--masks", masks + "/a.png"]).folder
    }
  }
}

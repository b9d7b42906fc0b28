import ArgumentParser
import Foundation
import TestSupport
import Testing

@testable import SharedCommands

@Suite struct AppleEngineTests {
  @Test(arguments: [
    ["--refine"], ["--keep-gaps"], ["--masks", "m"], ["--threads", "2"], ["--report", "r.json"],
    ["--preview", "p.png"], ["--dry-run"], ["--camera-distance", "a,b=1"],
  ])
  func optionsOfTheOtherEngineAreUnknown(_ options: [String]) {
    #expect(throws: (any Error).self) {
      try Reconstruct<AppleEngine>.parse(["a", "b.usdz"] + options)
    }
  }

  @Test func helpHasOnlyItsOptionsAndFormats() {
    let help = Reconstruct<AppleEngine>.helpMessage(columns: 80)
    for text in ["model.usdz", "--checkpoint-directory", "--quads", "DETAIL LEVELS", "EVENTS"] {
      #expect(help.contains(text), "\(text)")
    }
    for text in [".glb", ".ply  ", "MASKS", "SCALE", "--threads", "dry-run", "\n\n\n"] {
      #expect(!help.contains(text), "\(text)")
    }
  }

  @Test func onlyUSDZFilesAndFoldersAreWritten() throws {
    let temporary = try TemporaryFolder()
    let path = temporary.url.path
    try temporary.write([0], as: "photos/a.jpg")
    func files(_ output: String) throws -> ReconstructionFiles {
      try ReconstructionFiles(
        try ReconstructArguments<AppleEngine.Arguments>.parse([
          path + "/photos", path + "/" + output,
        ]), input: AppleEngine.input(path + "/photos"), formats: AppleEngine.modelFormats)
    }
    #expect(try files("m.usdz").output.format == .usdz)
    #expect(try files("m/").output.format == .folder)
    let failure = #expect(throws: CommandFailure.self) { try files("m.glb") }
    #expect(failure?.sentence.contains("Name a .usdz file, or a folder") == true)
  }
}

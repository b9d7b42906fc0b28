import SceneModel
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands
@testable import photogrammetry_cli

@Suite struct SubcommandTests {
  @Test func reconstructIsTheDefaultSubcommand() throws {
    let command = try PhotogrammetryCLI.parseAsRoot([
      "photos", "model.usdz", "-d", "medium", "-o", "sequential", "-f", "high",
    ])
    let reconstruct = try #require(command as? Reconstruct<PipelineEngine>).arguments
    #expect(reconstruct.inputFolder == "photos")
    #expect(reconstruct.output == "model.usdz")
    #expect(reconstruct.detail.detail == .level(.medium))
    #expect(reconstruct.alignment.sampleOrdering == .sequential)
    #expect(reconstruct.alignment.featureSensitivity == .high)
    #expect(!reconstruct.noObjectMasking)
  }

  @Test func subcommandsAreParsed() throws {
    #expect(try PhotogrammetryCLI.parseAsRoot(["inspect", "photos"]) is Inspect)
    #expect(
      try PhotogrammetryCLI.parseAsRoot(["evaluate", "ck", "--reference", "gt"]) is Evaluate)
    #expect(try PhotogrammetryCLI.parseAsRoot(["batch", "sets", "models"]) is Batch)
    #expect(try PhotogrammetryCLI.parseAsRoot(["align", "photos", "work"]) is Align)
    #expect(try PhotogrammetryCLI.parseAsRoot(["densify", "photos", "rig", "work"]) is Densify)
    #expect(try PhotogrammetryCLI.parseAsRoot(["export", "work", "m.usdz"]) is Export)
    #expect(try PhotogrammetryCLI.parseAsRoot(["doctor"]) is Doctor)
    #expect(
      (try PhotogrammetryCLI.parseAsRoot(["demo"]) as? Demo<PipelineEngine>)?.detail == .reduced)
  }

  @Test func versionIsPrintedToStdout() throws {
    let temporary = try TemporaryFolder()
    let run = try CommandProcess.run(["--version"], in: temporary.url)
    #expect(run.exitCode == 0 && run.errors.isEmpty)
    #expect(run.output == ProgramVersion.current + "\n")
    let verbose = try CommandProcess.run(["--version", "--verbose"], in: temporary.url)
    #expect(verbose.exitCode == 0 && verbose.errors.isEmpty)
    for library in ["photogrammetry-cli \(ProgramVersion.current)", "Embree 3.", "libheif 1."] {
      #expect(verbose.output.contains(library), "\(verbose.output)")
    }
    let numbers = ProgramVersion.current.split(separator: "-")[0].split(separator: ".")
    #expect(numbers.count == 3 && numbers.allSatisfy { Int($0) != nil })
  }
}

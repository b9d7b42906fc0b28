import EngineCommands
import Testing

@testable import SharedCommands

@Suite struct ReconstructTests {
  @Test func defaultsAreApples() throws {
    let command = try Reconstruct<AppleEngine>.parse(["a", "b.usdz"]).arguments
    #expect(command.detail.detail == .level(.reduced))
    #expect(command.alignment.sampleOrdering == .unordered)
    #expect(command.alignment.featureSensitivity == .normal)
    #expect(!command.noObjectMasking && !command.shape.quads && command.shape.crop == nil)
  }

  @Test func optionsOfEveryEngineAreParsed() throws {
    let command = try Reconstruct<AppleEngine>.parse([
      "a", "b/", "--detail", "raw", "-o", "sequential", "-f", "high", "--checkpoint-directory",
      "ck", "--poses", "p.json", "--point-cloud", "c.ply", "--no-object-masking", "--json",
      "--verbose",
    ]).arguments
    #expect(command.inputFolder == "a" && command.output == "b/")
    #expect(command.detail.detail == .level(.raw))
    #expect(command.alignment.sampleOrdering == .sequential)
    #expect(command.alignment.featureSensitivity == .high)
    #expect(command.checkpointDirectory == "ck")
    #expect(command.poses == "p.json" && command.pointCloud == "c.ply")
    #expect(command.noObjectMasking && command.json && command.logging.verbose)
  }

  @Test(arguments: [
    ["a"], ["a", "b.usdz", "c"], ["a", "b.usdz", "-d", "huge"],
    ["a", "b.usdz", "--quiet", "--verbose"], ["a", "b.usdz", "--sample-ordering", "random"],
    ["a", "b.usdz", "--unknown"],
  ])
  func invalidArgumentsAreRejected(_ arguments: [String]) {
    #expect(throws: (any Error).self) { try Reconstruct<AppleEngine>.parse(arguments) }
    #expect(throws: (any Error).self) { try Reconstruct<PipelineEngine>.parse(arguments) }
  }
}

import Formats
import Testing

@testable import EngineCommands
@testable import Pipeline
@testable import SharedCommands

@Suite struct CompressionArgumentsTests {
  private func check(_ format: ModelFormat, _ arguments: [String], _ detail: [String] = []) throws {
    try CompressionArguments.parse(arguments).check(format, try DetailArguments.parse(detail))
  }

  @Test func glbFilesCanBeCompressed() throws {
    try check(.glb, ["--compress"])
    try check(.glb, ["--compress"], ["-d", "custom", "--max-polygons", "100"])
    for format in ModelFormat.allCases { try check(format, []) }
  }

  @Test func otherCombinationsAreUsageErrors() {
    for format in ModelFormat.allCases where format != .glb {
      #expect { try check(format, ["--compress"]) } throws: {
        let failure = CommandFailure($0)
        return failure.exitCode == 2 && failure.sentence.contains(".glb")
      }
    }
    let detail = ["-d", "custom", "--texture-format", "png"]
    #expect { try check(.glb, ["--compress"], detail) } throws: {
      CommandFailure($0).sentence.contains("--texture-format")
    }
  }

  @Test func theOptionReachesTheConfigurationAndBatchRuns() throws {
    var configuration = PipelineConfiguration()
    try CompressionArguments.parse([]).apply(to: &configuration)
    #expect(configuration.export.glbCompression == nil)
    let arguments = try CompressionArguments.parse(["--compress"])
    arguments.apply(to: &configuration)
    #expect(configuration.export.glbCompression == GLBCompression())
    #expect(arguments.arguments == ["--compress"])
    #expect(try DetailArguments.parse(["--lod"]).arguments.last == "--lod")
  }
}

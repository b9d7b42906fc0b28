import Pipeline
import Testing

@testable import EngineCommands

@Suite struct PlannedArgumentsTests {
  @Test func chunksGetAllArgumentsOfTheRun() {
    let words = PlannedArguments.shared([
      "/usr/bin/photogrammetry-cli", "photos/", "-d", "medium", "--slurm", "--partition", "short",
      "--slurm-options=--qos=x", "m.usdz", "--threads", "8", "--report", "r.html", "--json",
      "--plan=p", "--checkpoint-directory", "c", "--photos-per-chunk", "3", "--up=-y",
    ])
    #expect(
      words == [
        "reconstruct", "photos/", "-d", "medium", "m.usdz", "--report", "r.html", "--up=-y",
      ])
    #expect(PlannedArguments.shared(["p", "reconstruct", "a", "b"]) == ["reconstruct", "a", "b"])
  }

  @Test func partsAreParsed() {
    #expect(PartArgument(argument: "photos") == .part(.photos))
    #expect(PartArgument(argument: "candidates") == .part(.candidates))
    #expect(PartArgument(argument: "pairs:1/2") == .part(.pairs(Block(index: 0, of: 2))))
    #expect(PartArgument(argument: "model") == .model)
    #expect(
      PartArgument(argument: "features:2/8") == .part(.features(Block(index: 1, of: 8))))
    #expect(
      PartArgument(argument: "patches:8/8") == .part(.views(.patches, Block(index: 7, of: 8))))
    for wrong in ["features", "features:0/8", "features:9/8", "pairs", "views:1/2", "", ":"] {
      #expect(PartArgument(argument: wrong) == nil, "\(wrong)")
    }
  }
}

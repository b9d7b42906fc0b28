import Evaluation
import Testing

@testable import EngineCommands

@Suite struct EvaluateTests {
  @Test func optionsAreParsed() throws {
    let evaluate = try Evaluate.parse([
      "ck", "--reference", "gt", "--threshold", "0.1", "0.2", "--floor", "z=-0.5",
    ])
    #expect(evaluate.comparison.threshold == [0.1, 0.2])
    #expect(evaluate.comparison.floor == Floor(axis: 2, height: -0.5))
    for option in [
      ["--floor", "0.1"], ["--floor", "w=1"], ["--floor", "z=nan"], ["--voxel", "inf"],
    ] {
      #expect(throws: (any Error).self) {
        try Evaluate.parse(["ck", "--reference", "gt"] + option)
      }
    }
    #expect(throws: (any Error).self) {
      try Evaluate.parse(["ck", "--reference", "gt", "--threshold", "-1"])
    }
  }
}

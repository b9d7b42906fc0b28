import Pipeline
import Testing

@testable import EngineCommands

@Suite struct UpArgumentsTests {
  @Test func sidesAndAxesAreNamed() throws {
    #expect(try UpArguments.parse([]).up == nil)
    #expect(try UpArguments.parse(["--up", "left"]).up?.direction == .photos(.left))
    #expect(try UpArguments.parse(["--up", "z"]).up?.direction == .model(.z))
    #expect(try UpArguments.parse(["--up=-x"]).up?.direction == .model(.minusX))
    for name in ChosenUp.names { #expect(ChosenUp(name: name)?.name == name) }
  }

  @Test(arguments: ["up", "Y", "+y", "", "1"]) func otherNamesAreRejected(name: String) {
    #expect(throws: (any Error).self) { try UpArguments.parse(["--up=" + name]) }
  }

  @Test func theChoiceReachesAlignment() throws {
    var configuration = PipelineConfiguration()
    try UpArguments.parse(["--up", "bottom"]).apply(to: &configuration)
    #expect(configuration.alignment.worldAlignment.chosenUp == .photos(.bottom))
  }
}

import Foundation
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct ScaleArgumentsTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  @Test func distancesComeFromOptionsAndFile() throws {
    let folder = temporary.url
    for name in ["a=1.jpg", "b.jpg"] { try temporary.write("", as: name) }
    let file = try temporary.write(
      """
      [{"meters": 0.2, "from": [{"photo": "a=1.jpg", "x": 1, "y": 2}, \
      {"photo": "b.jpg", "x": 3, "y": 4}],
        "to": [{"photo": "a=1.jpg", "x": 5, "y": 6}, {"photo": "b.jpg", "x": 7, "y": 8}]}]
      """, as: "points.json")
    let command = try ScaleArguments.parse([
      "--camera-distance", "a=1.jpg, b.jpg=0.42", "--measurements", file.path,
    ])
    let distances = try command.knownDistances(photos: folder)
    #expect(distances.count == 2 && distances.map(\.meters) == [0.42, 0.2])
    #expect(distances[0].from == .camera("a=1.jpg") && distances[0].to == .camera("b.jpg"))
    let far = try ScaleArguments.parse(["--camera-distance", "a=1.jpg,c.jpg=1"])
    let failure = #expect(throws: CommandFailure.self) {
      try far.knownDistances(photos: folder)
    }
    #expect(failure?.exitCode == 2 && failure?.sentence.contains("c.jpg") == true)
  }

  @Test(arguments: [
    "a.jpg=1", "a.jpg,b.jpg", "a.jpg,b.jpg=0", "a.jpg,a.jpg=1", "a.jpg,b.jpg=x",
    "a.jpg,b.jpg=1e300", "a.jpg,b.jpg=1e-300",
  ])
  func invalidCameraDistancesAreRejected(_ argument: String) {
    #expect(throws: (any Error).self) {
      try ScaleArguments.parse(["--camera-distance", argument])
    }
  }

  @Test(arguments: [
    "", "{}", "[]", #"[{"meters": 0, "from": [], "to": []}]"#,
    #"[{"meters": 1, "from": [{"photo": "a", "x": 1, "y": 1}], "to": []}]"#,
    """
    [{"meters": 1e300, "from": [{"photo": "a", "x": 1, "y": 2}, {"photo": "b", "x": 3, "y": 4}],
      "to": [{"photo": "a", "x": 5, "y": 6}, {"photo": "b", "x": 7, "y": 8}]}]
    """,
  ])
  func invalidMeasurementsAreRejected(_ text: String) throws {
    let file = try temporary.write(text, as: "m.json")
    let failure = #expect(throws: CommandFailure.self) { try MeasurementFile(file.path) }
    #expect(failure?.exitCode == 2 && failure?.sentence.contains("m.json") == true)
  }
}

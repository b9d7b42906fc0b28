import Foundation
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct ViewTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  private func text(_ name: String) throws -> String {
    String(decoding: try Data(contentsOf: folder.appendingPathComponent(name)), as: UTF8.self)
  }

  @Test func modelsOfOtherProgramsAreShown() throws {
    try temporary.write(
      """
      v 0 0 0
      v 1 0 0
      v 0 2 0
      f 1 2 3
      """, as: "part.obj")
    let run = try CommandProcess.run(["view", "part.obj"], in: folder)
    #expect(run.exitCode == 0 && run.output == "part.html\n", "\(run.errors)")
    let page = try text("part.html")
    #expect(page.contains("<title>part.obj</title>"))
    #expect(page.contains("[\"Size\",\"1.000 × 2.000 × 0.000\"]"))
  }

  @Test func whatIsNoModelFails() throws {
    try temporary.write("This is no model.", as: "broken.glb")
    try temporary.write("x", as: "notes.txt")
    for (name, words) in [
      ("broken.glb", ["broken.glb"]), ("notes.txt", ["notes.txt", "USDZ"]),
      ("missing.usdz", ["missing.usdz"]),
    ] {
      try CommandProcess.expectFailure(["view", name], in: folder, code: 2, mentioning: words)
    }
    let names = try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted()
    #expect(names == ["broken.glb", "notes.txt"])
  }

  @Test(.endToEnd) func runsAndCheckpointsAreShown() throws {
    let photos = Fixtures.images(of: "orbit").path
    let run = try CommandProcess.run(
      [photos, "m.usdz", "-d", "preview", "--viewer", "--checkpoint-directory", "work"],
      in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(run.output.contains("m.html"))
    #expect(try text("m.html").contains("<title>m.usdz</title>"))
    let view = try CommandProcess.run(["view", "work", "--no-open"], in: folder)
    #expect(view.exitCode == 0 && view.output == "work.html\n", "\(view.errors)")
    #expect(try text("work.html").contains("\"view_00.jpg\""))
  }

  @Test func thousandsAreSeparated() {
    #expect(
      [0, 12, 999, 1000, 1_234_567].map(ModelFacts.grouped)
        == ["0", "12", "999", "1,000", "1,234,567"])
  }
}

import Foundation
import Pipeline
import SharedCommands
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands

@Suite(.endToEnd) struct DemoTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private func names(_ folder: String) throws -> [String] {
    try FileManager.default.contentsOfDirectory(
      atPath: temporary.url.appendingPathComponent(folder).path
    ).sorted()
  }

  private func content(_ name: String) throws -> Data {
    try Data(contentsOf: temporary.url.appendingPathComponent(name))
  }

  @Test func aModelIsMadeFromRenderedPhotos() throws {
    let run = try CommandProcess.run(["demo", "-d", "preview"], in: temporary.url)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(run.output == "photogrammetry-demo/model.usdz\nphotogrammetry-demo/model.png\n")
    for words in ["Rendering 20 photos", "aligning photos", "Done in", "What was made", "--help"] {
      #expect(run.errors.contains(words), "\(run.errors)")
    }
    #expect(try names("photogrammetry-demo") == ["model.png", "model.usdz", "photos"])
    #expect(try names("photogrammetry-demo/photos") == (0..<20).map(DemoFolder.photoName))
    let json = try CommandProcess.run(
      ["demo", "-d", "preview", "--json", "--threads", "1", "--", "-other/"], in: temporary.url)
    let events = json.output.split(separator: "\n").compactMap { RunEvent(line: $0.utf8) }
    #expect(events.last?.event == "complete" && events.last?.registered == 20, "\(json.output)")
    #expect((events.last?.triangles ?? 0) > 10_000)
    for name in ["model.usdz", "model.png", "photos/demo_11.jpg"] {
      #expect(try content("photogrammetry-demo/\(name)") == content("-other/\(name)"))
    }
  }

  @Test func interruptsWhileRenderingExitWith130() throws {
    let run = try CommandProcess.run(["demo", "try"], in: temporary.url) { $0.interrupt() }
    #expect(run.exitCode == 130, "\(run.errors)")
    #expect(run.errors.contains("Interrupted; no model was written.") && run.output.isEmpty)
    #expect(try names("try") == ["photos"])
  }

  @Test func otherFilesAreRefused() throws {
    try temporary.write("x", as: "mine/IMG_1.jpg")
    try CommandProcess.expectFailure(
      ["demo", "mine"], in: temporary.url, code: 2, mentioning: ["holds IMG_1.jpg", "mine-2"])
    let json = try CommandProcess.run(["demo", "mine", "--json"], in: temporary.url)
    #expect(RunEvent(line: json.output.utf8)?.event == "failed" && json.exitCode == 2)
    #expect(try names("mine") == ["IMG_1.jpg"])
  }
}

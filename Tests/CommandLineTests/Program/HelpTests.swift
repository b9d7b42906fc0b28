import ArgumentParser
import Foundation
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands
@testable import photogrammetry_cli

@Suite struct HelpTests {
  /// Compares with a file in Snapshots; RECORD_SNAPSHOTS=1 rewrites it.
  private func expectSnapshot(_ help: String, _ name: String) throws {
    let file = URL(fileURLWithPath: #filePath).deletingLastPathComponent()
      .deletingLastPathComponent().appendingPathComponent("Snapshots/\(name).txt")
    if ProcessInfo.processInfo.environment["RECORD_SNAPSHOTS"] != nil {
      try Data((help + "\n").utf8).write(to: file)
    }
    #expect(help + "\n" == (try String(contentsOf: file, encoding: .utf8)))
  }

  @Test(arguments: [
    "photogrammetry-cli", "reconstruct", "batch", "align", "densify", "export", "inspect",
    "doctor", "demo", "evaluate", "check", "frames", "view", "chunk", "join", "watch",
  ])
  func helpMatchesItsSnapshot(_ name: String) throws {
    let commands: [String: any ParsableCommand.Type] = [
      "reconstruct": Reconstruct<PipelineEngine>.self, "batch": Batch.self, "align": Align.self,
      "densify": Densify.self, "export": Export.self, "inspect": Inspect.self,
      "doctor": Doctor.self, "demo": Demo<PipelineEngine>.self, "evaluate": Evaluate.self,
      "check": CheckModel.self, "frames": Frames.self, "view": View.self,
      "chunk": MakeChunk.self, "join": JoinChunks.self, "watch": WatchPlan.self,
    ]
    let help =
      commands[name].map { PhotogrammetryCLI.helpMessage(for: $0, columns: 80) }
      ?? PhotogrammetryCLI.helpMessage(columns: 80)
    try expectSnapshot(help, name)
  }

  @Test func helpOnMacMatchesItsSnapshot() throws {
    try expectSnapshot(
      Reconstruct<AppleEngine>.helpMessage(columns: 80), "reconstruct-on-mac")
  }

  @Test(arguments: ["bash", "zsh", "fish"])
  func completionScriptsHaveFoldersAndOptions(_ shell: String) throws {
    let temporary = try TemporaryFolder()
    let run = try CommandProcess.run(["--generate-completion-script", shell], in: temporary.url)
    #expect(run.exitCode == 0 && run.errors.isEmpty)
    let folders = ["bash": "compgen -d", "zsh": "_files -/", "fish": "__fish_complete_directories"]
    for words in ["keep-checkpoints", "sample-ordering", try #require(folders[shell])] {
      #expect(run.output.contains(words), "\(words)")
    }
  }

  @Test func helpGoesToStdout() throws {
    let temporary = try TemporaryFolder()
    let run = try CommandProcess.run(["--help"], in: temporary.url)
    #expect(run.exitCode == 0)
    #expect(run.output.contains("photogrammetry-cli photos/ model.usdz"))
    #expect(run.errors.isEmpty)
  }
}

import ArgumentParser
import Foundation
import TestSupport
import Testing

@testable import photogrammetry_cli

@Suite struct HelpTests {
  /// Compares with the files in Snapshots; write them anew with RECORD_SNAPSHOTS=1.
  @Test(arguments: [
    "photogrammetry-cli", "reconstruct", "batch", "align", "densify", "export", "inspect",
    "evaluate",
  ])
  func helpIsAsItWas(_ name: String) throws {
    let commands: [String: any ParsableCommand.Type] = [
      "reconstruct": Reconstruct.self, "batch": Batch.self, "align": Align.self,
      "densify": Densify.self,
      "export": Export.self, "inspect": Inspect.self, "evaluate": Evaluate.self,
    ]
    let help =
      commands[name].map { PhotogrammetryCLI.helpMessage(for: $0, columns: 80) }
      ?? PhotogrammetryCLI.helpMessage(columns: 80)
    let file = URL(fileURLWithPath: #filePath).deletingLastPathComponent()
      .appendingPathComponent("Snapshots/\(name).txt")
    if ProcessInfo.processInfo.environment["RECORD_SNAPSHOTS"] != nil {
      try Data((help + "\n").utf8).write(to: file)
    }
    #expect(help + "\n" == (try String(contentsOf: file, encoding: .utf8)))
  }

  @Test func helpGoesToStdout() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    let run = try CommandProcess.run(["--help"], in: folder)
    #expect(run.exitCode == 0)
    #expect(run.output.contains("photogrammetry-cli photos/ model.usdz"))
    #expect(run.errors.isEmpty)
    _ = temporary
  }
}

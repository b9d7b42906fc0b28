import ArgumentParser
import Foundation
import Testing

@testable import EngineCommands
@testable import photogrammetry_cli

@Suite struct DemoGuideTests {
  private let lines = DemoGuide(files: DemoFolder("try"), photoCount: 20).lines

  /// The commands in the lines, without the name of the program.
  private var commands: [[String]] {
    lines.filter { $0.hasPrefix("  photogrammetry-cli ") }.map { line in
      let command = line.dropFirst(2).components(separatedBy: "  ")[0]
      return command.split(separator: " ").dropFirst().map(String.init)
    }
  }

  @Test func filesAreNamed() {
    let text = lines.joined(separator: "\n")
    for path in ["try/photos ", "try/model.usdz ", "try/model.png ", "20 rendered photos"] {
      #expect(text.contains(path))
    }
    #expect(lines.allSatisfy { $0.count <= 100 })
  }

  @Test func itsCommandsAreValid() throws {
    #expect(commands.count == 4)
    for arguments in commands where arguments != ["--help"] {
      #expect(throws: Never.self) { try PhotogrammetryCLI.parseAsRoot(arguments) }
    }
  }
}

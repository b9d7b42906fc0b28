import Foundation
import Testing

/// A finished process of the built program.
struct CommandProcess {
  var exitCode: Int32
  var output: String
  var errors: String

  /// The program, which is built next to the bundle of the tests.
  static var program: URL {
    URL(fileURLWithPath: CommandLine.arguments[0]).deletingLastPathComponent()
      .appendingPathComponent("photogrammetry-cli")
  }

  /// Runs to the end, with empty standard input, and `environment` added to that of this process.
  /// Calls `interrupting` with the process once it has written to standard error.
  static func run(
    _ arguments: [String], in folder: URL, environment: [String: String] = [:],
    interrupting: ((Process) -> Void)? = nil
  ) throws -> CommandProcess {
    let process = Process()
    process.environment = ProcessInfo.processInfo.environment.merging(environment) { $1 }
    process.executableURL = program
    process.arguments = arguments
    process.currentDirectoryURL = folder
    let names = ["output", "errors"].map {
      FileManager.default.temporaryDirectory.appendingPathComponent("\($0)-\(UUID().uuidString)")
    }
    defer { for name in names { try? FileManager.default.removeItem(at: name) } }
    for name in names { try Data().write(to: name) }
    process.standardInput = FileHandle.nullDevice
    process.standardOutput = try FileHandle(forWritingTo: names[0])
    process.standardError = try FileHandle(forWritingTo: names[1])
    try process.run()
    if let interrupting {
      while process.isRunning, try text(of: names[1]).isEmpty { usleep(10_000) }
      interrupting(process)
    }
    process.waitUntilExit()
    return CommandProcess(
      exitCode: process.terminationStatus, output: try text(of: names[0]),
      errors: try text(of: names[1]))
  }

  /// Runs the program, which must exit with `code` and print nothing but an error that contains
  /// `words`.
  static func expectFailure(
    _ arguments: [String], in folder: URL, code: Int32, mentioning words: [String],
    sourceLocation: SourceLocation = #_sourceLocation
  ) throws {
    let run = try run(arguments, in: folder)
    #expect(run.exitCode == code, "\(run.errors)", sourceLocation: sourceLocation)
    #expect(run.output.isEmpty, sourceLocation: sourceLocation)
    for word in words {
      #expect(run.errors.contains(word), "\(run.errors)", sourceLocation: sourceLocation)
    }
  }

  private static func text(of file: URL) throws -> String {
    String(decoding: try Data(contentsOf: file), as: UTF8.self)
  }
}

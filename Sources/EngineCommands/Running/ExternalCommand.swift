import Foundation

/// A program of the system that was run to its end.
struct ExternalCommand: Equatable, Sendable {
  var exitCode: Int32
  var output: String
  var errors: String

  /// The file of a program in `PATH`; nil if there is none.
  static func path(of name: String) -> String? {
    (ProcessInfo.processInfo.environment["PATH"] ?? "").split(separator: ":")
      .map { "\($0)/\(name)" }.first { FileManager.default.isExecutableFile(atPath: $0) }
  }

  /// Runs the program at `path` with `input` as its standard input; throws if it can't be started.
  static func run(_ path: String, _ arguments: [String], input: String = "") throws
    -> ExternalCommand
  {
    let process = Process()
    process.executableURL = URL(fileURLWithPath: path)
    process.arguments = arguments
    let pipes = (input: Pipe(), output: Pipe(), errors: Pipe())
    (process.standardInput, process.standardOutput) = (pipes.input, pipes.output)
    process.standardError = pipes.errors
    try process.run()
    try? pipes.input.fileHandleForWriting.write(contentsOf: Data(input.utf8))
    try? pipes.input.fileHandleForWriting.close()
    // Both are short: neither pipe fills up while the other is read.
    let output = pipes.output.fileHandleForReading.readDataToEndOfFile()
    let errors = pipes.errors.fileHandleForReading.readDataToEndOfFile()
    process.waitUntilExit()
    return ExternalCommand(
      exitCode: process.terminationStatus, output: String(decoding: output, as: UTF8.self),
      errors: String(decoding: errors, as: UTF8.self))
  }
}

import Foundation

/// The built program while it runs.
final class BackgroundProcess {
  let process = Process()
  private let errorFile: URL

  /// Starts the program, with `environment` added to that of this process.
  init(
    _ arguments: [String], in folder: URL, environment: [String: String] = [:]
  ) throws {
    errorFile = FileManager.default.temporaryDirectory
      .appendingPathComponent("errors-\(UUID().uuidString)")
    try Data().write(to: errorFile)
    process.environment = ProcessInfo.processInfo.environment.merging(environment) { $1 }
    process.executableURL = CommandProcess.program
    process.arguments = arguments
    process.currentDirectoryURL = folder
    process.standardInput = FileHandle.nullDevice
    process.standardOutput = FileHandle.nullDevice
    process.standardError = try FileHandle(forWritingTo: errorFile)
    try process.run()
  }

  deinit {
    if process.isRunning { kill(process.processIdentifier, SIGKILL) }
    try? FileManager.default.removeItem(at: errorFile)
  }

  /// What it has written to standard error.
  var errors: String { (try? String(contentsOf: errorFile, encoding: .utf8)) ?? "" }

  func signal(_ number: Int32) { kill(process.processIdentifier, number) }

  /// Waits for the end; returns the exit code.
  func wait() -> Int32 {
    process.waitUntilExit()
    return process.terminationStatus
  }

  /// Waits at most `seconds` until a condition holds; returns whether it does.
  static func wait(_ seconds: Double, until condition: () -> Bool) -> Bool {
    let end = Date().addingTimeInterval(seconds)
    while Date() < end {
      if condition() { return true }
      usleep(50_000)
    }
    return condition()
  }
}

import Foundation
import TestLevels
import TestSupport
import Testing

@testable import SharedCommands

/// Signals are sent to processes of the program only, never to the process of the tests.
@Suite(.endToEnd) struct InterruptTests {
  private let temporary: TemporaryFolder

  init() throws {
    temporary = try TemporaryFolder()
    try temporary.writeNoisePhotos(24, to: "photos")
  }

  private func run(
    _ arguments: [String], interrupting: ((Process) -> Void)? = nil
  ) throws -> CommandProcess {
    try CommandProcess.run(arguments, in: temporary.url, interrupting: interrupting)
  }

  private func expectNoOutputFiles() throws {
    let names = try FileManager.default.contentsOfDirectory(atPath: temporary.url.path)
    #expect(names == ["photos"])
  }

  @Test func interruptExitsWith130() throws {
    let run = try run(["photos", "m.usdz"]) { $0.interrupt() }
    #expect(run.exitCode == 130, "\(run.errors)")
    #expect(run.errors.contains("Interrupted"))
    try expectNoOutputFiles()
  }

  /// Interrupted after masking, and run to the end.
  @Test(arguments: [true, false]) func scratchFoldersAreRemoved(isInterrupted: Bool) throws {
    let scratch = temporary.url.appendingPathComponent("scratch")
    try FileManager.default.createDirectory(at: scratch, withIntermediateDirectories: true)
    func names() throws -> [String] {
      try FileManager.default.contentsOfDirectory(atPath: scratch.path)
    }
    let run = try CommandProcess.run(
      [Fixtures.images(of: "orbit").path, "m.usdz", "--detail", "preview"], in: temporary.url,
      environment: ["TMPDIR": scratch.path]
    ) { process in
      guard isInterrupted else { return }
      while process.isRunning, (try? names().isEmpty) != false { usleep(10_000) }
      process.interrupt()
    }
    #expect(run.exitCode == (isInterrupted ? 130 : 0), "\(run.errors)")
    #expect(try names().isEmpty)
  }

  @Test(arguments: [
    ["photos", "m.usdz"], ["align", "photos", "work"], ["photos", "m.usdz", "--json"],
  ])
  func terminationExitsWith130(_ arguments: [String]) throws {
    let run = try run(arguments + ["--verbose"]) { $0.terminate() }
    #expect(run.exitCode == 130, "\(run.errors)")
    #expect(run.errors.contains("Interrupted"))
    if arguments.contains("--json") {
      let last = run.output.split(separator: "\n").last.flatMap { RunEvent(line: $0.utf8) }
      #expect(last?.event == "cancelled" && last?.message?.contains("Interrupted") == true)
    }
  }

  @Test func secondInterruptExitsImmediately() throws {
    let run = try run(["photos", "m.usdz"]) { process in
      process.interrupt()
      usleep(1000)
      process.interrupt()
      usleep(1000)
      process.terminate()
    }
    #expect(run.exitCode == 130, "\(run.errors)")
  }

  /// The standard input of these processes is empty. Photos of noise fail a run with exit code 1
  /// unless something stops it.
  @Test func endOfInputStopsARunUntilInputEnds() throws {
    let run = try run(["photos", "m.usdz", "--until-input-ends"])
    #expect(run.exitCode == 130, "\(run.errors)")
    try expectNoOutputFiles()
  }
}

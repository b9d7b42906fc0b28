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

import Foundation
import SceneModel
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct DoctorReportTests {
  private static let checks = [
    Check(.version, .ok, "1.0.0."), Check(.temporaryFolder, .note, "Small.", remedy: "Enlarge it."),
  ]
  private static let fault = Check(.memory, .problem, "None.", remedy: "Add some.")

  @Test func linesAreAligned() {
    let lines = DoctorReport(Self.checks).lines
    #expect(
      lines.prefix(3) == [
        "ok       version           1.0.0.", "note     temporary folder  Small.",
        "                           Enlarge it.",
      ])
    #expect(lines.count == 4 && lines[3].hasPrefix("Ready."))
  }

  @Test func onlyProblemsPreventARun() {
    #expect(DoctorReport(Self.checks).isReady)
    let report = DoctorReport(Self.checks + [Self.fault])
    #expect(!report.isReady && report.lines.last?.hasPrefix("1 problem:") == true)
  }

  /// Programs read these names: a change breaks them.
  @Test func keysAreStable() throws {
    let report = DoctorReport(Self.checks + [Self.fault])
    let data = Data(try report.encoded().utf8)
    #expect(try JSONDecoder().decode(DoctorReport.self, from: data) == report)
    let object = try #require(try JSONSerialization.jsonObject(with: data) as? [String: Any])
    #expect(object.keys.sorted() == ["checks", "isReady", "version"])
    let checks = try #require(object["checks"] as? [[String: Any]])
    #expect(checks[0].keys.sorted() == ["name", "status", "text"])
    #expect(checks[1].keys.sorted() == ["name", "remedy", "status", "text"])
    #expect(
      Check.Subject.allCases.map(\.rawValue) == [
        "version", "memory", "threads", "instructions", "imageFormats", "video",
        "temporaryFolder", "currentFolder", "scheduler", "terminal",
      ])
    #expect(Check.Status.allCases.map(\.rawValue) == ["ok", "note", "problem"])
  }

  @Test func executablesAreFoundOnThePath() throws {
    let temporary = try TemporaryFolder()
    let file = try temporary.write("", as: "bin/sbatch")
    let path = "/nowhere::" + temporary.url.appendingPathComponent("bin").path
    #expect(!DoctorReport.isOnPath("sbatch", path))
    try FileManager.default.setAttributes([.posixPermissions: 0o755], ofItemAtPath: file.path)
    #expect(DoctorReport.isOnPath("sbatch", path) && !DoctorReport.isOnPath("sbatch", ""))
  }

  @Test func theProgramPrintsTheReport() throws {
    let temporary = try TemporaryFolder()
    let run = try CommandProcess.run(["doctor", "--json"], in: temporary.url)
    let report = try JSONDecoder().decode(DoctorReport.self, from: Data(run.output.utf8))
    #expect(run.exitCode == (report.isReady ? 0 : 1) && run.errors.isEmpty)
    #expect(report.version == ProgramVersion.current && report.checks.count >= 7)
    #expect(report.checks.first { $0.name == .imageFormats }?.status == .ok)
    let broken = try CommandProcess.run(
      ["doctor"], in: temporary.url, environment: ["TMPDIR": "/proc/none"])
    #expect(broken.exitCode == 1 && broken.errors.isEmpty)
    #expect(broken.output.contains("problem  temporary folder"), "\(broken.output)")
    #expect(try FileManager.default.contentsOfDirectory(atPath: temporary.url.path).isEmpty)
  }
}

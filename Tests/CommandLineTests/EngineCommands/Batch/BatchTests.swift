import Foundation
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite(.endToEnd) struct BatchTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  private func addDataset(_ name: String, from fixture: String, photos: Int) throws {
    let files = FileManager.default
    let target = folder.appendingPathComponent("sets/\(name)", isDirectory: true)
    try files.createDirectory(at: target, withIntermediateDirectories: true)
    let source = Fixtures.images(of: fixture)
    for photo in try files.contentsOfDirectory(atPath: source.path).sorted().prefix(photos) {
      try files.copyItem(
        at: source.appendingPathComponent(photo), to: target.appendingPathComponent(photo))
    }
  }

  /// Adds datasets without a reconstructible model.
  private func addBrokenDatasets() throws {
    try addDataset("empty", from: "orbit", photos: 0)
    try addDataset("few", from: "orbit", photos: 2)
    for number in 0..<4 {
      try temporary.write("no photo", as: "sets/corrupt/\(number).jpg")
    }
  }

  private func summary() throws -> BatchSummary {
    let data = try Data(contentsOf: folder.appendingPathComponent("models/batch.json"))
    return try JSONDecoder().decode(BatchSummary.self, from: data)
  }

  private func batch(
    _ options: [String] = [], interrupting: ((Process) -> Void)? = nil
  ) throws -> CommandProcess {
    try CommandProcess.run(
      ["batch", "sets", "models", "-d", "preview"] + options, in: folder,
      interrupting: interrupting)
  }

  private var outputFiles: [String] {
    get throws {
      try FileManager.default.contentsOfDirectory(atPath: folder.path + "/models")
        .filter { !$0.hasPrefix(".") }.sorted()
    }
  }

  @Test func continuesAfterFailuresAndSkipsDoneDatasets() throws {
    try addBrokenDatasets()
    try addDataset("orbit", from: "orbit", photos: 20)
    let first = try batch(["--previews", "--poses", "--point-clouds"])
    #expect(first.exitCode == 1, "\(first.errors)")
    let files = ["orbit.png", "orbit.points.ply", "orbit.poses.json", "orbit.usdz"]
    #expect(try outputFiles == ["batch.csv", "batch.json"] + files)
    let made = try summary().datasets
    #expect(made.map(\.name) == ["corrupt", "empty", "few", "orbit"])
    #expect(made.map(\.status) == [.failed, .failed, .failed, .done])
    #expect(made.map(\.attempts) == [1, 1, 1, 1])
    #expect(made[3].photos == 20 && made[3].registered == 20 && (made[3].triangles ?? 0) > 1000)
    #expect(made[1].error?.contains("JPEG, HEIC or PNG") == true)
    #expect(made[2].error?.contains("at least 3") == true)
    #expect(first.output.contains("4 datasets: 1 done, 3 failed."))
    #expect(first.errors.contains("3 of 4 datasets have no model"))
    let work = try FileManager.default.contentsOfDirectory(atPath: folder.path + "/models/.work")
    #expect(!work.contains("orbit"))

    let model = folder.appendingPathComponent("models/orbit.usdz")
    let time = try FileManager.default.attributesOfItem(atPath: model.path)[.modificationDate]
    for name in ["corrupt", "empty", "few"] {
      try FileManager.default.removeItem(at: folder.appendingPathComponent("sets/\(name)"))
    }
    let second = try batch(["--previews", "--poses"])
    #expect(second.exitCode == 0, "\(second.errors)")
    #expect(try summary().datasets.map(\.status) == [.skipped])
    let third = try batch(["--json"])
    #expect(third.exitCode == 0)
    let events = third.output.split(separator: "\n").map { RunEvent(line: $0.utf8) }
    #expect(events.map(\.?.event) == ["ended", "complete"])
    #expect(events.last??.skipped == 1)
    try expectComparisonWithBaseline()
    let after = try FileManager.default.attributesOfItem(atPath: model.path)[.modificationDate]
    #expect(time as? Date == after as? Date)
  }

  /// Compares the batch with itself, and with one that had more.
  private func expectComparisonWithBaseline() throws {
    var baseline = try summary()
    #expect(baseline.datasets[0].quality?.verdict != nil)
    #expect(baseline.datasets[0].quality?.reprojection != nil)
    let same = try batch(["--baseline", "models/batch.json"])
    #expect(same.exitCode == 0 && same.output.contains("Nothing got worse."))
    baseline.datasets[0].registered = 21
    try temporary.write([UInt8](try baseline.json()), as: "earlier.json")
    let worse = try batch(["--baseline", "earlier.json"])
    #expect(worse.exitCode == CommandFailure.regressionCode)
    #expect(worse.errors.contains("orbit got worse: 20 photos have a pose, 21 before."))
  }

  @Test func killedRunIsRetried() throws {
    try addDataset("orbit", from: "orbit", photos: 20)
    // Any number is allowed: without a failure there is nothing to try again.
    let run = try batch(["--json", "--verbose", "--retries", "\(Int.max)"]) { process in
      for child in Self.children(of: process, count: 1) { kill(child, SIGKILL) }
    }
    let entry = try #require(try summary().datasets.first)
    #expect(run.exitCode == 0, "\(run.output)")
    #expect(entry.status == .done && entry.attempts == 2)
    for line in run.output.split(separator: "\n") {
      #expect(RunEvent(line: line.utf8) != nil, "\(line)")
    }
  }

  @Test(arguments: [SIGINT, SIGTERM])
  func interruptStopsAllRunsAndSavesTheSummary(_ signal: Int32) throws {
    try addDataset("a", from: "orbit", photos: 20)
    try addDataset("b", from: "orbit", photos: 20)
    let run = try batch(["--jobs", "2", "--threads", "1"]) { process in
      #expect(Self.children(of: process, count: 2).count == 2)
      kill(process.processIdentifier, signal)
    }
    #expect(run.exitCode == 130, "\(run.errors)")
    #expect(run.errors.contains("run the same command again"))
    #expect(try summary().datasets.map(\.status) == [.cancelled, .cancelled])
    #expect(try outputFiles == ["batch.csv", "batch.json"])
  }

  @Test func runsEndWithTheBatch() throws {
    try addDataset("a", from: "orbit", photos: 20)
    try addDataset("b", from: "orbit", photos: 20)
    var children: [Int32] = []
    _ = try batch(["--jobs", "2", "--threads", "1"]) { process in
      children = Self.children(of: process, count: 2)
      kill(process.processIdentifier, SIGKILL)
    }
    #expect(children.count == 2)
    let end = Date().addingTimeInterval(5)
    while Date() < end, children.contains(where: Self.isAlive) { usleep(50_000) }
    #expect(!children.contains(where: Self.isAlive))
  }

  @Test func invalidArgumentsExitWithTwo() throws {
    try FileManager.default.createDirectory(
      at: folder.appendingPathComponent("sets"), withIntermediateDirectories: true)
    try temporary.write([0], as: "sets/1.jpg")
    let none = try batch()
    #expect(none.exitCode == 2 && none.errors.contains("holds no folders"), "\(none.errors)")
    let same = try CommandProcess.run(["batch", "sets", "sets/"], in: folder)
    #expect(same.exitCode == 2 && same.errors.contains("folder of the photos"), "\(same.errors)")
    #expect(!FileManager.default.fileExists(atPath: folder.path + "/models"))
  }

  /// The child processes of a process, once there are `count`.
  static func children(of process: Process, count: Int) -> [Int32] {
    for _ in 0..<200 {
      let names = (try? FileManager.default.contentsOfDirectory(atPath: "/proc")) ?? []
      let children = names.compactMap { Int32($0) }.filter {
        state(of: $0)?.parent == process.processIdentifier
      }
      if children.count >= count { return children }
      usleep(20_000)
    }
    return []
  }

  private static func isAlive(_ process: Int32) -> Bool {
    state(of: process).map { $0.letter != "Z" } ?? false
  }

  private static func state(of process: Int32) -> (letter: Substring, parent: Int32)? {
    let text = try? String(contentsOfFile: "/proc/\(process)/stat", encoding: .utf8)
    // The name, in parentheses, may contain any character.
    guard let text, let end = text.lastIndex(of: ")") else { return nil }
    let fields = text[end...].split(separator: " ")
    guard fields.count > 2, let parent = Int32(fields[2]) else { return nil }
    return (fields[1], parent)
  }
}

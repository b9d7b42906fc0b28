import Foundation
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

/// Plans whose chunks are made by processes on this machine.
@Suite(.endToEnd) struct MakeChunkTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }
  private var photos: String { Fixtures.images(of: "orbit").path }

  private func run(_ arguments: [String]) throws -> CommandProcess {
    try CommandProcess.run(arguments, in: folder)
  }

  private func content(_ name: String) throws -> Data {
    try Data(contentsOf: folder.appendingPathComponent(name))
  }

  @Test func chunksMakeTheBytesOfARun() throws {
    let options = ["-d", "preview"]
    #expect(try run(["reconstruct", photos, "whole.usdz", "--quiet"] + options).exitCode == 0)
    let plan = try run(
      ["reconstruct", photos, "parts.usdz", "--plan", "plan", "--photos-per-chunk", "2"] + options)
    #expect(plan.exitCode == 0, "\(plan.errors)")
    let early = try run(["join", "plan"])
    #expect(early.exitCode == 1 && early.errors.contains("chunks are missing"), "\(early.errors)")
    // Out of order: a chunk makes whatever it needs and does not find.
    let late = try run(["chunk", "plan", "matches", "1"])
    #expect(late.exitCode == 0, "\(late.errors)")
    let all = try run(["join", "plan", "--jobs", "2"])
    #expect(all.exitCode == 0, "\(all.errors)")
    #expect(try content("whole.usdz") == content("parts.usdz"))
    let work = folder.appendingPathComponent("plan/work").path
    #expect(!FileManager.default.fileExists(atPath: work))
  }

  /// Unless the photos of a chunk are given.
  @Test func workOfSecondsIsNotDivided() throws {
    func stages(_ options: [String]) throws -> [String] {
      let words = ["reconstruct", photos, "m.usdz", "-d", "preview", "--plan", "plan"] + options
      #expect(try run(words).exitCode == 0)
      return try PlanFolder(reading: folder.appendingPathComponent("plan")).plan.stages.map(\.name)
    }
    let all = [
      "photos", "features", "coarse", "coarseCompleted", "patches", "completed", "cloud", "model",
    ]
    #expect(try stages([]) == ["photos", "cameras", "cloud", "model"])
    #expect(try Set(stages(["--photos-per-chunk", "9"])) == Set(all + ["cameras"]))
  }

  @Test func chunksOfTilesMakeTheBytesOfARun() throws {
    let options = ["-d", "preview", "--set", "tiling.maximumPoints=30000", "--tiles"]
    let whole = try run(
      ["reconstruct", photos, "whole.usdz", "--checkpoint-directory", "ck"] + options + ["one"])
    #expect(whole.exitCode == 0, "\(whole.errors)")
    let plan = try run(
      ["reconstruct", photos, "parts.usdz", "--plan", "plan", "--photos-per-chunk", "10"] + options
        + ["two"])
    #expect(plan.exitCode == 0, "\(plan.errors)")
    let all = try run(["join", "plan", "--jobs", "1"])
    #expect(all.exitCode == 0, "\(all.errors)")
    let names = try FileManager.default.contentsOfDirectory(
      atPath: folder.appendingPathComponent("one").path
    ).sorted()
    try #require(names.filter { $0.hasSuffix(".glb") }.count > 1)
    for name in names { #expect(try content("one/\(name)") == content("two/\(name)"), "\(name)") }
    #expect(try content("whole.usdz") == content("parts.usdz"))
    try resumesTiles(options, names)
  }

  /// A run that finds its tiles keeps them, and makes only what is damaged or missing.
  private func resumesTiles(_ options: [String], _ names: [String]) throws {
    let tiles = names.filter { $0.hasSuffix(".glb") }.map {
      folder.appendingPathComponent("one/\($0)")
    }
    let before = try tiles.map { try Data(contentsOf: $0) }
    try Data(before[0].dropLast(9)).write(to: tiles[0])
    let kept = try FileManager.default.attributesOfItem(atPath: tiles[1].path)[.systemFileNumber]
    let again = try run(
      ["reconstruct", photos, "whole.usdz", "--checkpoint-directory", "ck"] + options + ["one"])
    #expect(again.exitCode == 0, "\(again.errors)")
    #expect(try tiles.map { try Data(contentsOf: $0) } == before)
    let now = try FileManager.default.attributesOfItem(atPath: tiles[1].path)[.systemFileNumber]
    #expect(kept as? Int == now as? Int)
  }

  @Test func chunkOfAnotherProgramIsRefused() throws {
    #expect(try run(["reconstruct", photos, "m.usdz", "--plan", "plan"]).exitCode == 0)
    let url = folder.appendingPathComponent("plan", isDirectory: true)
    var plan = try PlanFolder(reading: url).plan
    plan.program = "1.0.0, build 0123456789abcdef"
    _ = try PlanFolder(writing: plan, to: url)
    try CommandProcess.expectFailure(
      ["chunk", "plan", "photos", "1"], in: folder, code: 2,
      mentioning: ["build 0123456789abcdef", "Install the same program"])
    try CommandProcess.expectFailure(
      ["chunk", "plan", "photos", "2"], in: folder, code: 2, mentioning: ["no chunk photos-0002"])
    try CommandProcess.expectFailure(
      ["chunk", "plan", "photos"], in: folder, code: 2, mentioning: ["Name the number"])
  }

  @Test func killedChunkMayBeMadeAgain() throws {
    #expect(
      try run(["reconstruct", photos, "m.usdz", "--plan", "plan", "-d", "preview"]).exitCode == 0)
    let chunk = try BackgroundProcess(["chunk", "plan", "cameras", "1"], in: folder)
    #expect(
      BackgroundProcess.wait(60) {
        !BatchTests.children(of: chunk.process, count: 1).isEmpty
      })
    for child in BatchTests.children(of: chunk.process, count: 1) { kill(child, SIGKILL) }
    #expect(chunk.wait() == MakeChunk.transientCode, "\(chunk.errors)")
    let planned = try PlanFolder(reading: folder.appendingPathComponent("plan"))
    let id = ChunkID(stage: "cameras", number: 1)
    let killed = try #require(planned.status(of: id))
    #expect(killed.isTransient && killed.isShortOfMemory && killed.attempts == 1)
    #expect(try run(["chunk", "plan", "cameras", "1"]).exitCode == 0)
    #expect(planned.doneStatus(of: id)?.attempts == 2)
  }

  @Test func interruptedChunkEndsAtOnce() throws {
    #expect(
      try run(["reconstruct", photos, "m.usdz", "--plan", "plan", "-d", "preview"]).exitCode == 0)
    let chunk = try BackgroundProcess(["chunk", "plan", "cameras", "1"], in: folder)
    _ = BatchTests.children(of: chunk.process, count: 1)
    chunk.signal(SIGTERM)
    #expect(chunk.wait() == 130, "\(chunk.errors)")
  }

  /// A shared folder that is read-only for a while: the chunk waits.
  @Test(.enabled(if: MakeChunkTests.canMount, "mounting is not allowed here"))
  func chunkWaitsForItsFolder() throws {
    #expect(
      try run(["reconstruct", photos, "m.usdz", "--plan", "plan", "-d", "preview"]).exitCode == 0)
    let plan = folder.appendingPathComponent("plan").path
    #expect(Self.mount(["--bind", plan, plan]))
    defer { _ = Self.tool("umount", ["-l", plan]) }
    #expect(Self.mount(["-o", "remount,bind,ro", plan]))
    let chunk = try BackgroundProcess(["chunk", "plan", "photos", "1"], in: folder)
    #expect(BackgroundProcess.wait(60) { chunk.errors.contains("can't be written to; waiting") })
    #expect(chunk.process.isRunning)
    #expect(Self.mount(["-o", "remount,bind,rw", plan]))
    #expect(chunk.wait() == 0, "\(chunk.errors)")
  }

  /// The machines' clocks may differ: no times are compared.
  @Test(.enabled(if: FileManager.default.isExecutableFile(atPath: "/usr/bin/faketime")))
  func clocksMayDiffer() throws {
    #expect(
      try run(["reconstruct", photos, "m.usdz", "--plan", "plan", "-d", "preview"]).exitCode == 0)
    for (stage, offset) in [("photos", "+1h"), ("cameras", "-1h"), ("cloud", "+1h")] {
      let words = ["-f", offset, CommandProcess.program.path, "chunk", "plan", stage, "1"]
      #expect(Self.tool("/usr/bin/faketime", words, in: folder) == 0, "\(stage)")
    }
    let all = try run(["join", "plan", "--jobs", "1"])
    #expect(all.exitCode == 0, "\(all.errors)")
    let folder = try PlanFolder(reading: folder.appendingPathComponent("plan"))
    #expect(folder.status(of: ChunkID(stage: "cameras", number: 1))?.attempts == 1)
  }

  private static let canMount: Bool = {
    guard let temporary = try? TemporaryFolder() else { return false }
    let path = temporary.url.path
    guard mount(["--bind", path, path]) else { return false }
    return tool("umount", ["-l", path]) == 0
  }()

  private static func mount(_ arguments: [String]) -> Bool { tool("mount", arguments) == 0 }

  private static func tool(_ name: String, _ arguments: [String], in folder: URL? = nil) -> Int32 {
    let process = Process()
    process.executableURL = URL(fileURLWithPath: "/usr/bin/env")
    process.arguments = [name] + arguments
    process.currentDirectoryURL = folder
    process.standardInput = FileHandle.nullDevice
    process.standardOutput = FileHandle.nullDevice
    process.standardError = FileHandle.nullDevice
    guard (try? process.run()) != nil else { return -1 }
    process.waitUntilExit()
    return process.terminationStatus
  }
}

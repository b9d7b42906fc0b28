import Foundation
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite struct PlanFolderTests {
  private let temporary: TemporaryFolder
  private let id = ChunkID(stage: "datasets", number: 2)

  init() throws { temporary = try TemporaryFolder() }

  private var url: URL { temporary.url.appendingPathComponent("plan", isDirectory: true) }

  private func chunk(_ name: String, writes: [String] = []) -> Chunk {
    Chunk(
      name: name, arguments: ["reconstruct", name], directory: "/", reads: [], writes: writes,
      fingerprint: name, expectedSeconds: 10, threads: 2, memoryBytes: 1 << 30)
  }

  private func folder(_ chunks: [Chunk]) throws -> PlanFolder {
    try PlanFolder(
      writing: ChunkPlan(stages: [ChunkStage(name: "datasets", chunks: chunks)]), to: url)
  }

  private func done(_ name: String, _ outputs: [ChunkOutput] = []) -> ChunkStatus {
    var status = ChunkStatus(fingerprint: name, status: .done, node: "n1")
    (status.seconds, status.attempts, status.outputs) = (20, 1, outputs)
    return status
  }

  private func failed(_ name: String) -> ChunkStatus {
    var status = ChunkStatus(fingerprint: name, status: .failed, node: "n2")
    status.error = "Too few photos."
    return status
  }

  @Test func planIsReadAsWritten() throws {
    let written = try folder([chunk("a"), chunk("b")])
    let read = try PlanFolder(reading: url)
    #expect(read.plan == written.plan)
    #expect(read.plan[id]?.name == "b" && read.plan[ChunkID(stage: "views", number: 1)] == nil)
    #expect("\(id)" == "datasets-0002")
    #expect(read.plan[ChunkID(stage: "datasets", number: 0)] == nil)
    #expect(throws: CommandFailure.self) { try PlanFolder(reading: temporary.url) }
    try temporary.write("{\"format\": 2, \"program\": \"\", \"stages\": []}", as: "plan/plan.json")
    #expect(throws: CommandFailure.self) { try PlanFolder(reading: url) }
  }

  @Test func statusCountsForTheSameWorkOnly() throws {
    let folder = try folder([chunk("a"), chunk("b")])
    #expect(folder.missing(in: folder.plan.stages[0]).count == 2)
    try folder.record(done("b"), of: id)
    #expect(folder.doneStatus(of: id)?.node == "n1")
    let other = try self.folder([chunk("a"), chunk("c")])
    #expect(other.status(of: id) == nil && other.doneStatus(of: id) == nil)
  }

  @Test func failureDoesNotReplaceSuccess() throws {
    let folder = try folder([chunk("a"), chunk("b")])
    try folder.record(done("b"), of: id)
    try folder.record(failed("b"), of: id)
    #expect(folder.status(of: id)?.status == .done)
    folder.forget(id)
    try folder.record(failed("b"), of: id)
    #expect(folder.status(of: id)?.status == .failed)
    try folder.record(done("b"), of: id)
    #expect(folder.doneStatus(of: id) != nil)
  }

  @Test func damagedFilesAreFound() throws {
    let file = try temporary.write("a model", as: "b.usdz")
    let folder = try folder([chunk("a"), chunk("b", writes: [file.path])])
    try folder.record(done("b", ChunkOutput.all(at: [file.path])), of: id)
    #expect(folder.forgetDamaged().isEmpty)
    // As long as before: the blocks of a file may be lost although its size is not.
    try temporary.write("\0\0\0\0\0\0\0", as: "b.usdz")
    #expect(folder.doneStatus(of: id) != nil)
    #expect(folder.forgetDamaged() == [id])
    #expect(folder.doneStatus(of: id) == nil)
    try folder.record(done("b", ChunkOutput.all(at: [file.path])), of: id)
    try temporary.write("a", as: "b.usdz")
    #expect(folder.doneStatus(of: id) == nil)
  }

  @Test func outputsOfAFolderAreAllItsFiles() throws {
    try temporary.write("1", as: "model/a.obj")
    try temporary.write("22", as: "model/maps/b.png")
    let outputs = ChunkOutput.all(at: [temporary.url.path + "/model", "/nowhere"])
    #expect(outputs.map(\.bytes) == [1, 2])
    #expect(outputs.map(\.isIntact) == [true, true])
  }

  @Test func damagedStatusCountsAsMissing() throws {
    let folder = try folder([chunk("a"), chunk("b")])
    try folder.record(done("b"), of: id)
    try temporary.write("{\"status\": \"do", as: "plan/status/datasets-0002.json")
    #expect(folder.status(of: id) == nil)
  }

  @Test func progressIsThatOfTheWork() throws {
    let folder = try folder([chunk("a"), chunk("b"), chunk("c"), chunk("d")])
    try folder.record(done("b"), of: id)
    try folder.record(failed("c"), of: ChunkID(stage: "datasets", number: 3))
    let running = ChunkID(stage: "datasets", number: 4)
    var progress = ChunkProgress(fingerprint: "d", node: "n1")
    progress.fraction = 0.5
    try folder.record(progress, of: running)
    var known: [ChunkID: ChunkStatus] = [:]
    let all = PlanProgress(folder, known: &known, running: [running])
    #expect(all.text == "datasets: 1 of 4 done, 1 running, 1 failed")
    #expect(abs(all.fraction - 0.375) < 1e-9)
    // The chunk that is done took twice its time.
    #expect(all.remaining == 50)
    #expect(known.keys.map(\.number) == [2])
  }
}

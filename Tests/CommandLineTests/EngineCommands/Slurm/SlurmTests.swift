import Foundation
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

/// Runs on a real Slurm of two nodes.
@Suite(
  .endToEnd, .mostlyWaiting, .serialized,
  .disabled(if: SlurmCluster.shortfall != nil, "\(SlurmCluster.shortfall ?? "")"))
struct SlurmTests {
  private let temporary: TemporaryFolder
  private let cluster: SlurmCluster

  init() throws {
    temporary = try TemporaryFolder()
    cluster = try SlurmCluster()
  }

  private var folder: URL { temporary.url }

  private func run(_ arguments: [String]) throws -> CommandProcess {
    try CommandProcess.run(arguments, in: folder, environment: cluster.environment)
  }

  private func addDataset(_ name: String, photos: Int) throws {
    let target = folder.appendingPathComponent("sets/\(name)", isDirectory: true)
    try FileManager.default.createDirectory(at: target, withIntermediateDirectories: true)
    let source = Fixtures.images(of: "orbit")
    for photo in try FileManager.default.contentsOfDirectory(atPath: source.path).sorted()
      .prefix(photos)
    {
      try FileManager.default.copyItem(
        at: source.appendingPathComponent(photo), to: target.appendingPathComponent(photo))
    }
  }

  /// Writes a plan of several chunks that read photos and are made within seconds.
  private func writePlan(
    _ stages: [(name: String, part: String, count: Int)], memoryBytes: Int = 2 << 30
  ) throws -> PlanFolder {
    let photos = Fixtures.images(of: "orbit").path
    let stages = stages.map { stage in
      ChunkStage(
        name: stage.name,
        chunks: (1...stage.count).map { number in
          let work = folder.appendingPathComponent("work-\(stage.name)-\(number)").path
          return Chunk(
            name: "\(stage.name) \(number)",
            arguments: [
              "reconstruct", photos, "m.usdz", "--json", "--until-input-ends",
              "--checkpoint-directory", work, "--part", stage.part,
            ],
            directory: folder.path, reads: [photos], writes: [work + "/units"],
            fingerprint: "\(stage.name) \(number)", expectedSeconds: 2, threads: 1,
            memoryBytes: memoryBytes)
        })
    }
    let url = folder.appendingPathComponent("plan", isDirectory: true)
    #expect(try run(["reconstruct", photos, "m.usdz", "--plan", "plan"]).exitCode == 0)
    // That of the tests has another hash.
    let program = try PlanFolder(reading: url).plan.program
    let plan = try PlanFolder(writing: ChunkPlan(program: program, stages: stages), to: url)
    let settings = SlurmSettings(
      options: [], retries: 2, maximumThreads: 1,
      maximumMegabytes: try cluster.megabytesPerNode(), program: CommandProcess.program.path)
    try SlurmFolder(of: plan).write(settings)
    return plan
  }

  private func watch() throws -> CommandProcess { try run(["watch", "plan"]) }

  @Test func batchGivesTheSameAsHere() throws {
    try addDataset("a", photos: 12)
    try addDataset("b", photos: 14)
    try addDataset("few", photos: 2)
    let cluster = try run(["batch", "sets", "cluster", "-d", "preview", "--slurm"])
    #expect(cluster.exitCode == 1, "\(cluster.errors)")
    #expect(cluster.errors.contains("few failed on s"), "\(cluster.errors)")
    #expect(cluster.output.contains("3 datasets: 2 done, 1 failed."))
    let here = try run(["batch", "sets", "here", "-d", "preview", "--quiet"])
    #expect(here.exitCode == 1)
    for name in ["a.usdz", "b.usdz"] {
      let (one, other) = (
        folder.appendingPathComponent("cluster/\(name)"),
        folder.appendingPathComponent("here/\(name)")
      )
      #expect(try Data(contentsOf: one) == Data(contentsOf: other))
    }
    let again = try run(["batch", "sets", "cluster", "-d", "preview", "--slurm"])
    #expect(again.output.contains("3 datasets: 2 skipped, 1 failed."), "\(again.output)")
  }

  /// The page's first commands, typed by someone who knows nothing else.
  @Test func firstBatchFollowsThePage() throws {
    try addDataset("chair", photos: 12)
    let page = try String(contentsOf: Self.page, encoding: .utf8)
    let section = try #require(page.components(separatedBy: "## The first batch\n").last)
    let lines = section.prefix(upTo: try #require(section.range(of: "\n## ")).lowerBound)
      .split(separator: "\n")
    let commands = lines.filter { $0.hasPrefix("$ photogrammetry-cli ") }
    #expect(commands.count == 3)
    for command in commands {
      let process = try run(command.split(separator: " ").dropFirst(2).map(String.init))
      #expect(process.exitCode == 0, "\(command): \(process.errors)")
    }
    let model = folder.appendingPathComponent("models/chair.usdz")
    #expect(FileManager.default.fileExists(atPath: model.path))
  }

  private static let page = URL(fileURLWithPath: #filePath)
    .appendingPathComponent("../../../../../docs/clusters.md").standardizedFileURL

  @Test func runIsTheSameOnManyMachines() throws {
    let photos = Fixtures.images(of: "orbit").path
    let cluster = try run([
      "reconstruct", photos, "cluster.usdz", "-d", "preview", "--slurm", "--photos-per-chunk", "8",
    ])
    #expect(cluster.exitCode == 0, "\(cluster.errors)")
    let here = try run(["reconstruct", photos, "here.usdz", "-d", "preview", "--quiet"])
    #expect(here.exitCode == 0)
    #expect(
      try Data(contentsOf: folder.appendingPathComponent("cluster.usdz"))
        == Data(contentsOf: folder.appendingPathComponent("here.usdz")))
    let plan = try PlanFolder(reading: folder.appendingPathComponent("cluster.usdz.plan"))
    #expect(
      try SlurmFolder(of: plan).settings().maximumMegabytes == self.cluster.megabytesPerNode())
  }

  @Test func jobsContinueWithoutTheCommand() throws {
    let plan = try writePlan([("photos", "photos", 2), ("features", "features:1/1", 2)])
    let watch = try BackgroundProcess(
      ["watch", "plan"], in: folder, environment: cluster.environment)
    #expect(BackgroundProcess.wait(60) { watch.errors.contains("Submitted") })
    watch.signal(SIGKILL)
    _ = watch.wait()
    // The second stage is submitted by a job of the first.
    let isDone = BackgroundProcess.wait(240) {
      plan.plan.stages.allSatisfy { plan.missing(in: $0).isEmpty }
    }
    #expect(isDone)
    #expect(try self.watch().exitCode == 0)
  }

  @Test func secondInterruptCancelsTheJobs() throws {
    let plan = try writePlan([("features", "features:1/1", 6)])
    let watch = try BackgroundProcess(
      ["watch", "plan"], in: folder, environment: cluster.environment)
    #expect(BackgroundProcess.wait(60) { watch.errors.contains("Submitted") })
    watch.signal(SIGINT)
    #expect(BackgroundProcess.wait(60) { watch.errors.contains("The jobs continue") })
    watch.signal(SIGINT)
    #expect(watch.wait() == 130)
    #expect(watch.errors.contains("The jobs are canceled"), "\(watch.errors)")
    #expect(!plan.missing(in: plan.plan.stages[0]).isEmpty)
    #expect(try self.watch().exitCode == 0)
    #expect(plan.missing(in: plan.plan.stages[0]).isEmpty)
  }

  /// A killed chunk may have been short of memory, but no node has twice as much.
  @Test func killedChunksAndNodesAreReplaced() throws {
    let memory = try cluster.megabytesPerNode()
    let plan = try writePlan(
      [("features", "features:1/1", 4)], memoryBytes: memory / 4 * 3 << 20)
    let watch = try BackgroundProcess(
      ["watch", "plan"], in: folder, environment: cluster.environment)
    let first = ChunkID(stage: "features", number: 1)
    #expect(BackgroundProcess.wait(90) { plan.progress(of: first) != nil })
    // The process of the chunk, not the one that it watches.
    for process in Self.processes(containing: "chunk\0\(plan.url.path)\0features\01\0") {
      kill(process, SIGKILL)
    }
    try cluster.kill("s2")
    #expect(watch.wait() == 0, "\(watch.errors)")
    #expect(plan.missing(in: plan.plan.stages[0]).isEmpty)
    let asked = try SlurmFolder(of: plan).submissions().map(\.resources.memoryMegabytes)
    #expect(asked.contains(memory), "\(asked)")
    try cluster.revive("s2")
  }

  @Test func memoryIsDoubledWhereItRanOut() throws {
    let plan = try writePlan([("features", "features:1/1", 1)], memoryBytes: 60 << 20)
    let watch = try watch()
    #expect(watch.exitCode == 0, "\(watch.errors)")
    let submissions = try SlurmFolder(of: plan).submissions()
    #expect(submissions.count > 1)
    #expect(submissions.last?.resources.memoryMegabytes ?? 0 >= 120)
  }

  @Test func damagedFileIsMadeAgain() throws {
    let plan = try writePlan([("photos", "photos", 2)])
    #expect(try watch().exitCode == 0)
    let id = ChunkID(stage: "photos", number: 2)
    let output = try #require(plan.status(of: id)?.outputs.first)
    try Data("half".utf8).write(to: URL(fileURLWithPath: output.path))
    let check = try run(["join", "plan"])
    #expect(check.exitCode == 1, "\(check.errors)")
    #expect(try watch().exitCode == 0)
    #expect(plan.status(of: id)?.outputs.first == output)
  }

  @Test func twoJoinsAtOnceAgree() throws {
    try addDataset("few", photos: 2)
    let batch = try run(["batch", "sets", "models", "--plan", "plan"])
    #expect(batch.exitCode == 0, "\(batch.errors)")
    let joins = try (0..<2).map { _ in
      try BackgroundProcess(
        ["join", "plan", "--jobs", "1"], in: folder, environment: cluster.environment)
    }
    #expect(joins.map { $0.wait() } == [1, 1])
    let data = try Data(contentsOf: folder.appendingPathComponent("models/batch.json"))
    let summary = try JSONDecoder().decode(BatchSummary.self, from: data)
    #expect(summary.datasets.map(\.status) == [.failed])
  }

  /// The processes whose arguments, each followed by a zero byte, contain a text.
  private static func processes(containing text: String) -> [Int32] {
    let names = (try? FileManager.default.contentsOfDirectory(atPath: "/proc")) ?? []
    return names.compactMap { Int32($0) }.filter { process in
      let line = FileManager.default.contents(atPath: "/proc/\(process)/cmdline") ?? Data()
      return String(decoding: line, as: UTF8.self).contains(text)
    }
  }
}

import Formats
import Foundation
import SharedCommands

/// The folder of a plan, which all machines that work on it see.
///
/// ```
/// plan.json                     the chunks
/// status/views-0003.json        how the last attempt ended
/// status/views-0003.running     how far the present attempt is
/// logs/views-0003.log           what its process wrote to standard error
/// ```
/// Every file is written atomically. There are no locks, and no times are compared: the same chunk
/// made twice gives the same files.
struct PlanFolder: Sendable {
  let url: URL
  let plan: ChunkPlan

  /// Reads a plan; throws a `CommandFailure`.
  init(reading url: URL) throws {
    let file = Self.planFile(in: url)
    guard let data = FileManager.default.contents(atPath: file.path) else {
      throw CommandFailure.usage(
        "\(url.relativePath) holds no plan.json. Name the folder of a plan, as 'batch --plan' "
          + "writes it.")
    }
    guard let plan = try? JSONDecoder().decode(ChunkPlan.self, from: data),
      plan.format == ChunkPlan.currentFormat
    else {
      throw CommandFailure.usage(
        "\(file.relativePath) is not a plan of this version of the program. Write it again with "
          + "the command that made it.")
    }
    (self.url, self.plan) = (url, plan)
  }

  /// Writes a plan, replacing the one in the folder; chunks that both have stay done. Throws
  /// `OutputError`.
  init(writing plan: ChunkPlan, to url: URL) throws {
    (self.url, self.plan) = (url, plan)
    for folder in [url, statusFolder, logFolder] {
      do {
        try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
      } catch {
        throw OutputError.notWritable(path: folder.path)
      }
    }
    try AtomicFile.write(try JSONEncoder.readable.encode(plan), to: Self.planFile(in: url))
  }

  private static func planFile(in folder: URL) -> URL {
    folder.appendingPathComponent("plan.json", isDirectory: false)
  }

  private var statusFolder: URL { url.appendingPathComponent("status", isDirectory: true) }

  /// The folder of all logs.
  var logFolder: URL { url.appendingPathComponent("logs", isDirectory: true) }

  /// The log of a chunk's process.
  func log(of id: ChunkID) -> URL { logFolder.appendingPathComponent("\(id).log") }
}

// MARK: - The state of chunks

extension PlanFolder {
  /// How the last attempt at a chunk ended; nil if there was none, or if its file is damaged.
  func status(of id: ChunkID) -> ChunkStatus? {
    let status: ChunkStatus? = read(statusFile(of: id))
    return status?.fingerprint == plan[id]?.fingerprint ? status : nil
  }

  /// How far the present attempt at a chunk is; nil if there is none.
  func progress(of id: ChunkID) -> ChunkProgress? {
    let progress: ChunkProgress? = read(progressFile(of: id))
    return progress?.fingerprint == plan[id]?.fingerprint ? progress : nil
  }

  /// The status of a chunk that is done, with all its files; nil if it has to be made.
  func doneStatus(of id: ChunkID) -> ChunkStatus? {
    guard let status = status(of: id), status.status == .done,
      status.outputs.allSatisfy(\.isThere), let chunk = plan[id],
      !chunk.areSealed || chunk.writes.allSatisfy(FileManager.default.fileExists)
    else { return nil }
    return status
  }

  /// Records how an attempt ended. A failure doesn't replace the success of another process. Throws
  /// `OutputError`.
  func record(_ status: ChunkStatus, of id: ChunkID) throws {
    if status.status == .done || doneStatus(of: id) == nil {
      try AtomicFile.write(try JSONEncoder.readable.encode(status), to: statusFile(of: id))
    }
    try? FileManager.default.removeItem(at: progressFile(of: id))
  }

  /// Records how far an attempt is; throws `OutputError`.
  func record(_ progress: ChunkProgress, of id: ChunkID) throws {
    try AtomicFile.write(try JSONEncoder().encode(progress), to: progressFile(of: id))
  }

  /// Forgets an attempt, so that the chunk has to be made.
  func forget(_ id: ChunkID) {
    for file in [statusFile(of: id), progressFile(of: id)] {
      try? FileManager.default.removeItem(at: file)
    }
  }

  /// Forgets the chunks whose files have changed since they were made, and returns them. Reads all
  /// files.
  func forgetDamaged() -> [ChunkID] {
    let damaged = plan.stages.flatMap(\.ids).filter { id in
      doneStatus(of: id).map { !$0.outputs.allSatisfy(\.isIntact) } ?? false
    }
    damaged.forEach(forget)
    return damaged
  }

  /// Whether all results are there: then the other chunks are of no use any more.
  var isComplete: Bool { plan.results.allSatisfy { doneStatus(of: $0) != nil } }

  /// The chunks that have to be made.
  var missing: [ChunkID] { isComplete ? [] : plan.stages.flatMap(missing) }

  /// The chunks of a stage that have to be made.
  func missing(in stage: ChunkStage) -> [ChunkID] {
    stage.ids.filter { doneStatus(of: $0) == nil }
  }

  private func statusFile(of id: ChunkID) -> URL {
    statusFolder.appendingPathComponent("\(id).json", isDirectory: false)
  }

  private func progressFile(of id: ChunkID) -> URL {
    statusFolder.appendingPathComponent("\(id).running", isDirectory: false)
  }

  private func read<Value: Decodable>(_ file: URL) -> Value? {
    FileManager.default.contents(atPath: file.path)
      .flatMap { try? JSONDecoder().decode(Value.self, from: $0) }
  }
}

import Formats
import Foundation
import SharedCommands

/// What the plan of a batch needs besides its chunks: `batch.json` in the folder of the plan.
struct BatchRecord: Codable, Equatable {
  /// The stage of the plan.
  static let stage = "datasets"

  /// All datasets as they were before. Those without a chunk have a model.
  var entries: [BatchEntry]
  /// The path of the folder of the models.
  var models: String
  var hasReports: Bool
  /// The path of the batch to compare with.
  var baseline: String?

  /// The record in the folder of a plan; nil if the plan is not that of a batch.
  init?(of plan: URL) {
    guard let data = FileManager.default.contents(atPath: Self.file(in: plan).path),
      let record = try? JSONDecoder().decode(BatchRecord.self, from: data)
    else { return nil }
    self = record
  }

  init(entries: [BatchEntry], models: String, hasReports: Bool, baseline: String?) {
    (self.entries, self.models) = (entries, models)
    (self.hasReports, self.baseline) = (hasReports, baseline)
  }

  /// Writes the record into the folder of a plan.
  func write(to plan: URL) throws {
    try FileManager.default.createDirectory(at: plan, withIntermediateDirectories: true)
    try AtomicFile.write(try JSONEncoder.readable.encode(self), to: Self.file(in: plan))
  }

  private static func file(in plan: URL) -> URL { plan.appendingPathComponent("batch.json") }

  /// The state of all datasets, with the results of the chunks.
  func summary(_ folder: PlanFolder) -> BatchSummary {
    var entries = entries
    for (id, chunk) in zip(stage(folder).ids, stage(folder).chunks) {
      guard let index = entries.firstIndex(where: { $0.name == chunk.name }) else { continue }
      entries[index].record(folder.status(of: id), isDone: folder.doneStatus(of: id) != nil)
    }
    return BatchSummary(datasets: entries)
  }

  private func stage(_ folder: PlanFolder) -> ChunkStage {
    folder.plan.stage(Self.stage) ?? ChunkStage(name: Self.stage, chunks: [])
  }

  /// Writes the summary next to the models, and returns the conclusion.
  func conclude(_ folder: PlanFolder) throws -> BatchConclusion {
    let url = URL(fileURLWithPath: models, isDirectory: true)
    let summary = summary(folder)
    try BatchFiles(url: url).write(summary, hasReports: hasReports)
    return BatchConclusion(
      summary: summary, baseline: try baseline.map { try BatchBaseline($0) }, models: url)
  }
}

extension BatchEntry {
  /// Takes over how the last attempt at the dataset's chunk ended.
  fileprivate mutating func record(_ status: ChunkStatus?, isDone: Bool) {
    guard let status else { return }
    (self.status, error) = (status.status, status.error)
    (seconds, attempts) = (status.seconds, status.attempts)
    if let counts = status.result {
      photos = counts.photos ?? photos
      (registered, triangles, quality) = (counts.registered, counts.triangles, counts.quality)
    }
    if status.status == .done, !isDone {
      (self.status, error) = (.failed, "Files of the model are missing or damaged.")
    }
  }
}

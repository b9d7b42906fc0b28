import Formats
import Foundation
import Pipeline
import SharedCommands

/// The output folder of a batch: models, `batch.json`, `batch.csv` and, in the hidden `.work`,
/// unfinished runs.
final class BatchFolder: Sendable {
  let url: URL
  let format: ModelFormat
  /// The levels that are written besides the model's.
  let coarserLevels: [DetailArgument]
  // Retained for its lifetime only.
  private nonisolated(unsafe) let lock: DirectoryLock

  /// Creates the folder if it is missing; throws a `CommandFailure` if that fails or if another
  /// batch is writing to it.
  init(_ url: URL, format: ModelFormat, coarserLevels: [DetailArgument] = []) throws {
    self.url = url
    self.format = format
    self.coarserLevels = coarserLevels
    do {
      lock = try DirectoryLock(Self.work(in: url), isShared: false)
    } catch CheckpointError.inUse {
      throw CommandFailure.usage(
        "Another batch is writing to \(url.relativePath). Wait until it ends, or name another "
          + "folder."
      )
    } catch {
      throw CommandFailure.usage(
        "The folder \(url.relativePath) can't be written to. Name another, or change its "
          + "permissions."
      )
    }
  }

  private static func work(in folder: URL) -> URL {
    folder.appendingPathComponent(".work", isDirectory: true)
  }

  /// The name of a dataset's model.
  func modelName(of dataset: BatchDataset) -> String {
    format == .folder ? dataset.name : "\(dataset.name).\(format.rawValue)"
  }

  /// The path of a dataset's model, as an argument of `reconstruct`.
  func modelPath(of dataset: BatchDataset) -> String {
    url.appendingPathComponent(modelName(of: dataset)).path + (format == .folder ? "/" : "")
  }

  /// The path of a file next to a dataset's model.
  func path(of companion: BatchCompanion, of dataset: BatchDataset) -> String {
    url.appendingPathComponent(dataset.name + companion.suffix, isDirectory: false).path
  }

  /// Whether the model and the files next to it exist.
  func hasModel(of dataset: BatchDataset, with companions: [BatchCompanion]) -> Bool {
    let coarser = coarserLevels.map {
      url.appendingPathComponent("\(dataset.name)-\($0.rawValue).\(format.rawValue)").path
    }
    return ([modelPath(of: dataset)] + coarser + companions.map { path(of: $0, of: dataset) })
      .allSatisfy { FileManager.default.fileExists(atPath: $0) }
  }

  /// The checkpoint directory of a dataset's run.
  func checkpoint(of dataset: BatchDataset) -> URL {
    Self.work(in: url).appendingPathComponent(dataset.name, isDirectory: true)
  }

  /// The log of a dataset's run.
  func log(of dataset: BatchDataset) -> URL {
    Self.work(in: url).appendingPathComponent("\(dataset.name).log", isDirectory: false)
  }

  /// Removes the checkpoint and the log of a dataset.
  func removeWork(on dataset: BatchDataset) {
    for url in [checkpoint(of: dataset), log(of: dataset)] {
      try? FileManager.default.removeItem(at: url)
    }
  }

  /// Entries of earlier batches by name; empty if batch.json is missing or can't be parsed.
  func earlierEntries() -> [String: BatchEntry] {
    guard let data = FileManager.default.contents(atPath: summaryFile.path),
      let summary = try? JSONDecoder().decode(BatchSummary.self, from: data)
    else { return [:] }
    return Dictionary(summary.datasets.map { ($0.name, $0) }) { first, _ in first }
  }

  /// Writes batch.csv and batch.json.
  func write(_ summary: BatchSummary) throws {
    try AtomicFile.write(Data(summary.csv.utf8), to: url.appendingPathComponent("batch.csv"))
    try AtomicFile.write(try summary.json(), to: summaryFile)
  }

  /// Writes the page that lists the reports.
  func writeIndex(of summary: BatchSummary) throws {
    try AtomicFile.write(
      summary.index(in: url).encoded, to: url.appendingPathComponent("index.html"))
  }

  private var summaryFile: URL { url.appendingPathComponent("batch.json") }
}

#if canImport(Pipeline)
  import Formats
  import Foundation
  import Pipeline

  /// The folder that a batch fills: models, `batch.json`, `batch.csv` and, hidden, the work that isn't
  /// finished.
  final class BatchFolder: Sendable {
    let url: URL
    let format: ModelFormat
    // Held for its lifetime only.
    private nonisolated(unsafe) let lock: DirectoryLock

    /// Makes the folder where it is missing; throws a `CommandFailure` where that can't be, or where
    /// another batch is at work in it.
    init(_ url: URL, format: ModelFormat) throws {
      self.url = url
      self.format = format
      do {
        lock = try DirectoryLock(Self.work(in: url), isShared: false)
      } catch CheckpointError.inUse {
        throw CommandFailure.usage(
          "Another batch is writing to \(url.relativePath). Wait until it ends, or name another folder."
        )
      } catch {
        throw CommandFailure.usage(
          "The folder \(url.relativePath) can't be written to. Name another, or change its permissions."
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

    /// The path of a dataset's model, as `ModelOutput` takes it.
    func modelPath(of dataset: BatchDataset) -> String {
      url.appendingPathComponent(modelName(of: dataset)).path + (format == .folder ? "/" : "")
    }

    /// The path of what is written beside a dataset's model.
    func path(of companion: BatchCompanion, of dataset: BatchDataset) -> String {
      url.appendingPathComponent(dataset.name + companion.suffix, isDirectory: false).path
    }

    /// Whether the model is there, and what was to be written beside it.
    func hasModel(of dataset: BatchDataset, with companions: [BatchCompanion]) -> Bool {
      ([modelPath(of: dataset)] + companions.map { path(of: $0, of: dataset) })
        .allSatisfy { FileManager.default.fileExists(atPath: $0) }
    }

    /// Where a run of a dataset leaves finished stages.
    func checkpoint(of dataset: BatchDataset) -> URL {
      Self.work(in: url).appendingPathComponent(dataset.name, isDirectory: true)
    }

    /// What a run of a dataset says.
    func log(of dataset: BatchDataset) -> URL {
      Self.work(in: url).appendingPathComponent("\(dataset.name).log", isDirectory: false)
    }

    func removeWork(on dataset: BatchDataset) {
      for url in [checkpoint(of: dataset), log(of: dataset)] {
        try? FileManager.default.removeItem(at: url)
      }
    }

    /// What earlier runs have left, by name; nothing where the file is missing or damaged.
    func earlierEntries() -> [String: BatchEntry] {
      guard let data = FileManager.default.contents(atPath: summaryFile.path),
        let summary = try? JSONDecoder().decode(BatchSummary.self, from: data)
      else { return [:] }
      return Dictionary(summary.datasets.map { ($0.name, $0) }) { first, _ in first }
    }

    func write(_ summary: BatchSummary) throws {
      try AtomicFile.write(Data(summary.csv.utf8), to: url.appendingPathComponent("batch.csv"))
      try AtomicFile.write(try summary.json(), to: summaryFile)
    }

    private var summaryFile: URL { url.appendingPathComponent("batch.json") }
  }
#endif

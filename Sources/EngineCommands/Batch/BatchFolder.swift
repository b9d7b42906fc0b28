import Formats
import Foundation
import Pipeline
import SharedCommands

/// The output folder of a batch: models, `batch.json`, `batch.csv` and, in the hidden `.work`,
/// unfinished runs.
final class BatchFolder: Sendable {
  let files: BatchFiles
  let format: ModelFormat
  /// The levels that are written besides the model's.
  let coarserLevels: [DetailArgument]
  // Retained for its lifetime only.
  private nonisolated(unsafe) let lock: DirectoryLock

  /// Creates the folder if it is missing; throws a `CommandFailure` if that fails or if another
  /// batch is writing to it.
  init(_ url: URL, format: ModelFormat, coarserLevels: [DetailArgument] = []) throws {
    files = BatchFiles(url: url)
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

  private var url: URL { files.url }

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
    results(of: dataset, with: companions)
      .allSatisfy { FileManager.default.fileExists(atPath: $0) }
  }

  /// The paths of a dataset's models and of the files next to them.
  func results(of dataset: BatchDataset, with companions: [BatchCompanion]) -> [String] {
    let coarser = coarserLevels.map {
      url.appendingPathComponent("\(dataset.name)-\($0.rawValue).\(format.rawValue)").path
    }
    return [modelPath(of: dataset)] + coarser + companions.map { path(of: $0, of: dataset) }
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

  /// The arguments of `reconstruct` for a dataset, without the number of threads. `companions` are
  /// written next to the model; `options` are those that all datasets share.
  func arguments(
    for dataset: BatchDataset, _ companions: [BatchCompanion], options: [String]
  ) -> [String] {
    let files = companions.flatMap { [$0.option, path(of: $0, of: dataset)] }
    return [
      "reconstruct", dataset.photos.path, modelPath(of: dataset), "--json", "--until-input-ends",
      "--checkpoint-directory", checkpoint(of: dataset).path,
    ] + files + dataset.arguments + options
  }

  /// The entries of datasets: skipped are those with a model from the same photos and options.
  func entries(
    of datasets: [BatchDataset], _ companions: [BatchCompanion], options: [String]
  ) -> [BatchEntry] {
    let earlier = files.earlierEntries()
    return datasets.map { dataset in
      let fingerprint = dataset.fingerprint(options: options)
      let model = modelName(of: dataset)
      if var entry = earlier[dataset.name], [.done, .skipped].contains(entry.status),
        entry.fingerprint == fingerprint, entry.model == model,
        hasModel(of: dataset, with: companions)
      {
        entry.status = .skipped
        return entry
      }
      return BatchEntry(
        name: dataset.name, status: .cancelled, photos: dataset.photoCount, model: model,
        fingerprint: fingerprint)
    }
  }
}

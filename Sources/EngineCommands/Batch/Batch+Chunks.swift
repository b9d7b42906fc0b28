import Foundation
import Logging
import Pipeline
import SharedCommands

// A batch as chunks: one per dataset, made on a cluster or by other schedulers.

extension Batch {
  /// Writes the plan, and follows it on Slurm, or names the commands that make it.
  func runChunks(_ reporter: RunReporter) async throws -> CommandFailure? {
    let output = URL(fileURLWithPath: models, isDirectory: true)
    let url =
      slurm.planFolder.map { URL(fileURLWithPath: $0, isDirectory: true) }
      ?? output.appendingPathComponent(".work/.plan", isDirectory: true)
    try slurm.check()
    if slurm.slurm, let (record, run) = try runInProgress(url) {
      Logger(label: "photogrammetry-cli").info("The jobs of an earlier call are not finished yet.")
      return try await follow(run, record, reporter)
    }
    let (record, folder) = try writePlan(to: url.standardizedFileURL)
    guard slurm.slurm else {
      folder.describe()
      return nil
    }
    let run = try SlurmRun(folder, settings: try SlurmSettings(slurm, retries: retries))
    return try await follow(run, record, reporter)
  }

  private func follow(
    _ run: SlurmRun, _ record: BatchRecord, _ reporter: RunReporter
  ) async throws -> CommandFailure? {
    _ = try await SlurmWatch(run: run, style: reporter.style).follow()
    return try record.conclude(run.folder).report(reporter)
  }

  /// The plan in a folder if it has jobs that wait or run: it must not change until they end.
  private func runInProgress(_ url: URL) throws -> (BatchRecord, SlurmRun)? {
    guard let record = BatchRecord(of: url), let run = try SlurmRun.inProgress(url) else {
      return nil
    }
    return (record, run)
  }

  private func writePlan(to url: URL) throws -> (BatchRecord, PlanFolder) {
    let (datasets, folder) = try datasetsAndFolder()
    let entries = folder.entries(of: datasets, companions, options: modelArguments)
    let chunks = zip(datasets, entries).filter { $1.status != .skipped }.map { dataset, entry in
      chunk(dataset, entry, folder)
    }
    let record = BatchRecord(
      entries: entries, models: URL(fileURLWithPath: models).standardizedFileURL.path,
      hasReports: reports,
      baseline: baseline.map { URL(fileURLWithPath: $0).standardizedFileURL.path })
    try record.write(to: url)
    let stage = ChunkStage(name: BatchRecord.stage, chunks: chunks, isPartial: true)
    return (record, try PlanFolder(writing: ChunkPlan(stages: [stage]), to: url))
  }

  private func chunk(
    _ dataset: BatchDataset, _ entry: BatchEntry, _ folder: BatchFolder
  ) -> Chunk {
    let options =
      modelArguments + MachineLimits.arguments() + (logging.verbose ? ["--verbose"] : [])
    let limits = detail.limits
    let threads = threads ?? Chunk.usualThreads
    let durations = StageDurationModel(
      photos: PhotoTotals(count: entry.photos), finest: limits, threadCount: threads)
    let arguments = folder.arguments(for: dataset, companions, options: options)
    return Chunk(
      name: dataset.name, arguments: arguments,
      directory: FileManager.default.currentDirectoryPath,
      reads: [dataset.photos.path]
        + [dataset.masks, dataset.measurements].compactMap { $0?.path },
      writes: folder.results(of: dataset, with: companions),
      scratch: keepCheckpoints ? nil : folder.checkpoint(of: dataset).path,
      fingerprint: dataset.fingerprint(options: arguments),
      expectedSeconds: durations.total, threads: threads,
      memoryBytes: detail.detail.expectedMemoryBytes + Chunk.spareMemory)
  }
}

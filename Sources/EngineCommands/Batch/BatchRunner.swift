import Foundation
import Logging
import SceneModel
import SharedCommands

/// Processes the datasets of a batch, several at once, each in a separate process.
final class BatchRunner: Sendable {
  struct Options: Sendable {
    var plan: BatchPlan
    var retries: Int
    var keepsCheckpoints: Bool
    /// Arguments of `reconstruct` besides those that differ between datasets.
    var arguments: [String]
    /// Files written next to each model.
    var companions: [BatchCompanion]
  }

  private struct State {
    var entries: [BatchEntry]
    /// Indices of datasets to process, in reverse order.
    var open: [Int] = []
    /// Indices of datasets whose failure may be transient.
    var retries: [Int] = []
    var running: [Int: ChildRun] = [:]
    var isStopping = false
  }

  private let datasets: [BatchDataset]
  private let folder: BatchFolder
  private let options: Options
  private let progress: BatchProgress
  private let state: Locked<State>
  private let logger = Logger(label: "photogrammetry-cli")

  /// Skips the datasets that have a model from the same photos and options `modelArguments`.
  init(
    _ datasets: [BatchDataset], in folder: BatchFolder, modelArguments: [String],
    companions: [BatchCompanion], _ style: RunReporter.Style,
    options: (_ open: Int) -> Options
  ) {
    let entries = folder.entries(of: datasets, companions, options: modelArguments)
    let open = entries.indices.filter { entries[$0].status != .skipped }
    self.datasets = datasets
    self.folder = folder
    self.options = options(open.count)
    progress = BatchProgress(style, count: open.count)
    state = Locked(State(entries: entries, open: open.reversed()))
  }

  var summary: BatchSummary { BatchSummary(datasets: state.withLock { $0.entries }) }

  /// Stops all runs and starts no more.
  func stop() {
    let runs = state.withLock { state in
      state.isStopping = true
      return Array(state.running.values)
    }
    runs.forEach { $0.stop() }
  }

  /// Processes all datasets. Those whose failure may be transient are tried again at the end, one
  /// at a time.
  func run() async throws {
    try save()
    let open = summary.datasets.count { $0.status != .skipped }
    logger.info(
      "\(open) of \(datasets.count) datasets to process, at most \(options.plan.jobs) at once.")
    for entry in summary.datasets where entry.status == .skipped {
      progress.ended(entry, path: nil)
    }
    try await process(jobs: options.plan.jobs)
    while reopenRetries() { try await process(jobs: 1) }
    progress.finish()
  }

  /// Puts the datasets that are to be tried again in line; returns false if there are none.
  private func reopenRetries() -> Bool {
    state.withLock { state in
      state.open = state.retries.sorted().reversed()
      state.retries = []
      return !state.isStopping && !state.open.isEmpty
    }
  }

  private func process(jobs: Int) async throws {
    try await withThrowingTaskGroup(of: Void.self) { group in
      for _ in 0..<jobs {
        group.addTask { while try await self.processNext() {} }
      }
      try await group.waitForAll()
    }
  }

  /// Processes a dataset; returns false if none is left.
  private func processNext() async throws -> Bool {
    let next: (index: Int, run: ChildRun)? = state.withLock { state in
      guard !state.isStopping, let index = state.open.popLast() else { return nil }
      let dataset = datasets[index]
      let run = ChildRun(arguments(for: dataset), log: folder.log(of: dataset))
      state.running[index] = run
      return (index, run)
    }
    guard let (index, run) = next else { return false }
    let dataset = datasets[index]
    let start = ProcessInfo.processInfo.systemUptime
    progress.began(dataset.name)
    let outcome = await run.run { self.progress.forward($0, of: dataset.name) }
    let result = ChildResult(outcome, log: folder.log(of: dataset))
    let entry = state.withLock { state in
      state.running[index] = nil
      state.entries[index].record(
        result, seconds: ProcessInfo.processInfo.systemUptime - start)
      let entry = state.entries[index]
      if entry.status == .failed, result.isTransient, entry.attempts <= options.retries {
        state.retries.append(index)
      }
      return entry
    }
    progress.ended(entry, path: folder.modelPath(of: dataset))
    if entry.status == .done, !options.keepsCheckpoints { folder.removeWork(on: dataset) }
    try save()
    return true
  }

  private func arguments(for dataset: BatchDataset) -> [String] {
    folder.arguments(for: dataset, options.companions, options: options.arguments)
      + ["--threads", "\(options.plan.threads)"]
  }

  /// Writes the current summary, under the lock so that an older one never overwrites a newer one.
  private func save() throws {
    try state.withLock { state in
      try folder.files.write(
        BatchSummary(datasets: state.entries), hasReports: options.companions.contains(.report))
    }
  }
}

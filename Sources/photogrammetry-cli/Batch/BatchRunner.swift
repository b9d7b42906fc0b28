#if canImport(Pipeline)
  import Foundation
  import Logging
  import SceneModel

  /// Works through the datasets of a batch, some at once, each in a process of its own.
  final class BatchRunner: Sendable {
    struct Options: Sendable {
      var plan: BatchPlan
      var retries: Int
      var keepsCheckpoints: Bool
      /// Of `reconstruct`, beyond the folders.
      var arguments: [String]
      /// Written beside each model.
      var companions: [BatchCompanion]
    }

    private struct State {
      var entries: [BatchEntry]
      /// Indices of what is to be done, from the last.
      var open: [Int] = []
      /// What failed of a cause that may pass.
      var again: [Int] = []
      var running: [Int: ChildRun] = [:]
      var isStopping = false
    }

    private let datasets: [BatchDataset]
    private let folder: BatchFolder
    private let options: Options
    private let progress: BatchProgress
    private let state: Locked<State>
    private let logger = Logger(label: "photogrammetry-cli")

    /// Finds out what is done already.
    init(
      _ datasets: [BatchDataset], in folder: BatchFolder, stamped: [String],
      companions: [BatchCompanion], _ style: RunReporter.Style,
      options: (_ open: Int) -> Options
    ) {
      let earlier = folder.earlierEntries()
      let entries = datasets.map { dataset in
        Self.entry(
          of: dataset, stamp: dataset.stamp(options: stamped), earlier[dataset.name],
          model: folder.modelName(of: dataset),
          isThere: folder.hasModel(of: dataset, with: companions))
      }
      let open = entries.indices.filter { entries[$0].status != .skipped }
      self.datasets = datasets
      self.folder = folder
      self.options = options(open.count)
      progress = BatchProgress(style, count: open.count)
      state = Locked(State(entries: entries, open: open.reversed()))
    }

    private static func entry(
      of dataset: BatchDataset, stamp: String, _ earlier: BatchEntry?, model: String, isThere: Bool
    ) -> BatchEntry {
      if var entry = earlier, [.done, .skipped].contains(entry.status), entry.stamp == stamp,
        entry.model == model, isThere
      {
        entry.status = .skipped
        return entry
      }
      return BatchEntry(
        name: dataset.name, status: .cancelled, photos: dataset.photoCount, model: model,
        stamp: stamp)
    }

    var summary: BatchSummary { BatchSummary(datasets: state.withLock { $0.entries }) }

    /// Asks all runs to stop, and begins no more.
    func stop() {
      let runs = state.withLock { state in
        state.isStopping = true
        return Array(state.running.values)
      }
      runs.forEach { $0.stop() }
    }

    /// Runs to the end. What failed of a cause that may pass is tried again afterwards, alone.
    func run() async throws {
      try save()
      let open = summary.datasets.count { $0.status != .skipped }
      logger.info(
        "\(open) of \(datasets.count) datasets to do, \(options.plan.jobs) at once at most.")
      for entry in summary.datasets where entry.status == .skipped {
        progress.ended(entry, path: nil)
      }
      try await work(jobs: options.plan.jobs)
      for _ in 0..<options.retries {
        state.withLock { state in
          state.open = state.again.sorted().reversed()
          state.again = []
        }
        try await work(jobs: 1)
      }
      progress.finish()
    }

    private func work(jobs: Int) async throws {
      try await withThrowingTaskGroup(of: Void.self) { group in
        for _ in 0..<jobs {
          group.addTask { while try await self.workOnNext() {} }
        }
        try await group.waitForAll()
      }
    }

    /// Says whether there was anything to do.
    private func workOnNext() async throws -> Bool {
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
      let outcome = await run.run { self.progress.take($0, of: dataset.name) }
      let result = BatchResult(outcome, log: folder.log(of: dataset))
      let entry = state.withLock { state in
        state.running[index] = nil
        state.entries[index].take(
          result, seconds: ProcessInfo.processInfo.systemUptime - start)
        let entry = state.entries[index]
        if entry.status == .failed, result.mayPass, entry.attempts <= options.retries {
          state.again.append(index)
        }
        return entry
      }
      progress.ended(entry, path: folder.modelPath(of: dataset))
      if entry.status == .done, !options.keepsCheckpoints { folder.removeWork(on: dataset) }
      try save()
      return true
    }

    private func arguments(for dataset: BatchDataset) -> [String] {
      var arguments = [
        "reconstruct", dataset.photos.path, folder.modelPath(of: dataset), "--json",
        "--until-input-ends", "--checkpoint-directory", folder.checkpoint(of: dataset).path,
        "--threads", "\(options.plan.threads)",
      ]
      for companion in options.companions {
        arguments += [companion.option, folder.path(of: companion, of: dataset)]
      }
      return arguments + dataset.words + options.arguments
    }

    /// Writes what is known so far, one thread at a time, so that the last one wins.
    private func save() throws {
      try state.withLock { try folder.write(BatchSummary(datasets: $0.entries)) }
    }
  }
#endif

import Foundation
import Logging
import SceneModel
import SharedCommands

/// Makes a chunk in a process of its own, and records how it ended.
struct ChunkRun: Sendable {
  /// How often a chunk is made again whose folder could not be written to for a while. Chosen.
  private static let attempts = 3
  /// Time between two attempts to write to a folder, in seconds. Chosen.
  private static let pause = 5.0
  /// How long to wait for a folder that can't be written to, in seconds: a server that restarts is
  /// back by then. Chosen.
  private static let patience = 600.0
  /// Least time between two records of the progress, in seconds, so that a thousand chunks don't
  /// load the server of the folder. Chosen.
  private static let progressInterval = 3.0

  let folder: PlanFolder
  let id: ChunkID
  /// The number of threads; nil for all usable processors.
  var threads: Int?

  private let child = Locked<ChildRun?>(nil)
  private let isStopped = Locked(false)
  private let logger = Logger(label: "photogrammetry-cli")

  init(_ id: ChunkID, of folder: PlanFolder, threads: Int? = nil) {
    (self.id, self.folder, self.threads) = (id, folder, threads)
  }

  /// Requests a stop; the chunk can be resumed.
  func stop() {
    isStopped.withLock { $0 = true }
    child.withLock { $0?.stop() }
  }

  /// Makes the chunk unless it is done, and returns how it ended. Calls `onEvent` with the events
  /// of the process, on another thread. Throws a `CommandFailure` if the chunk can't be made here.
  func run(_ onEvent: @escaping @Sendable (RunEvent) -> Void = { _ in }) async throws -> ChunkStatus
  {
    guard let chunk = folder.plan[id] else {
      throw CommandFailure.usage("The plan \(folder.url.relativePath) has no chunk \(id).")
    }
    guard folder.plan.program == ChunkPlan.thisProgram else {
      throw CommandFailure.usage(
        "The plan is of \(folder.plan.program), and this is \(ChunkPlan.thisProgram): their "
          + "results may differ. Install the same program on all machines, or write the plan again."
      )
    }
    if let done = folder.doneStatus(of: id) { return done }
    for _ in 1..<Self.attempts {
      if let status = try await attempt(chunk, onEvent) { return status }
    }
    guard let status = try await attempt(chunk, onEvent) else { throw unwritable }
    return status
  }

  /// Makes the chunk once; nil if its folder could not be written to meanwhile.
  private func attempt(
    _ chunk: Chunk, _ onEvent: @escaping @Sendable (RunEvent) -> Void
  ) async throws -> ChunkStatus? {
    try await waitUntilWritable(chunk)
    let start = ProcessInfo.processInfo.systemUptime
    let run = ChildRun(
      chunk.arguments + threadArguments, in: URL(fileURLWithPath: chunk.directory),
      log: folder.log(of: id))
    child.withLock { $0 = run }
    if isStopped.withLock({ $0 }) { run.stop() }
    let writer = ProgressWriter(folder, id, initialProgress(chunk), Self.progressInterval)
    let outcome = await run.run { event in
      writer.received(event)
      onEvent(event)
    }
    let result = ChildResult(outcome, log: folder.log(of: id))
    if result.status == .failed, writer.hasFailed { return nil }
    let earlier = folder.status(of: id)
    var status = ChunkStatus(
      fingerprint: chunk.fingerprint, status: result.status, node: Node.name, job: Node.job)
    status.seconds =
      (earlier?.seconds ?? 0) + ProcessInfo.processInfo.systemUptime - start
    status.attempts = (earlier?.attempts ?? 0) + 1
    (status.error, status.result) = (result.error, result.counts)
    (status.warnings, status.written) = (writer.warnings, writer.written)
    (status.isTransient, status.isShortOfMemory) = (result.isTransient, result.isShortOfMemory)
    if result.status == .done, !chunk.areSealed {
      status.outputs = ChunkOutput.all(at: chunk.writes)
    }
    do {
      try folder.record(status, of: id)
    } catch {
      return nil
    }
    if result.status == .done, let scratch = chunk.scratch {
      try? FileManager.default.removeItem(atPath: scratch)
    }
    return status
  }

  private var threadArguments: [String] { threads.map { ["--threads", "\($0)"] } ?? [] }

  private func initialProgress(_ chunk: Chunk) -> ChunkProgress {
    ChunkProgress(fingerprint: chunk.fingerprint, node: Node.name, job: Node.job)
  }

  private var unwritable: CommandFailure {
    .run(
      "The folder \(folder.url.relativePath) can't be written to. Make it writable on this machine "
        + "(\(Node.name)), and make the chunk again.", isTransient: true)
  }

  /// Returns once the folder can be written to; throws a `CommandFailure` if that takes too long.
  private func waitUntilWritable(_ chunk: Chunk) async throws {
    let end = ProcessInfo.processInfo.systemUptime + Self.patience
    var isReported = false
    while true {
      do {
        return try folder.record(initialProgress(chunk), of: id)
      } catch {
        guard ProcessInfo.processInfo.systemUptime < end, !isStopped.withLock({ $0 }) else {
          throw unwritable
        }
        if !isReported {
          logger.warning("The folder \(folder.url.path) can't be written to; waiting for it.")
        }
        isReported = true
        try await Task.sleep(for: .seconds(Self.pause))
      }
    }
  }
}

/// Records the progress of a chunk, at intervals.
private final class ProgressWriter: Sendable {
  private struct State {
    var progress: ChunkProgress
    var writtenAt = 0.0
    var hasFailed = false
    var warnings: [String] = []
    var written: [RunEvent] = []
  }

  private let folder: PlanFolder
  private let id: ChunkID
  private let interval: Double
  private let state: Locked<State>

  init(_ folder: PlanFolder, _ id: ChunkID, _ progress: ChunkProgress, _ interval: Double) {
    (self.folder, self.id, self.interval) = (folder, id, interval)
    state = Locked(State(progress: progress))
  }

  /// Whether a record could not be written.
  var hasFailed: Bool { state.withLock { $0.hasFailed } }

  /// The warnings of the run, each once.
  var warnings: [String] { state.withLock { $0.warnings } }

  /// The events about files that were written.
  var written: [RunEvent] { state.withLock { $0.written } }

  func received(_ event: RunEvent) {
    if event.event == "written" { state.withLock { $0.written.append(event) } }
    if event.event == "warning", let message = event.message {
      state.withLock { state in
        if !state.warnings.contains(message) { state.warnings.append(message) }
      }
    }
    guard let fraction = event.fraction else { return }
    state.withLock { state in
      (state.progress.fraction, state.progress.stage) = (fraction, event.stage)
      let now = ProcessInfo.processInfo.systemUptime
      guard now - state.writtenAt >= interval else { return }
      state.writtenAt = now
      do {
        try folder.record(state.progress, of: id)
      } catch {
        state.hasFailed = true
      }
    }
  }
}

import Foundation
import Pipeline
import SceneModel
import SharedCommands

/// Makes the chunks of a plan in processes on this machine.
struct LocalChunks: Sendable {
  private struct State {
    var open: [ChunkID] = []
    /// Of each chunk: those of a stage with fewer chunks than jobs get more.
    var threads = 1
    var attempts: [ChunkID: Int] = [:]
    var running: [ChunkID: ChunkRun] = [:]
    var reporter: PlanReporter
    var isStopped = false
  }

  private let folder: PlanFolder
  private let jobs: Int
  private let retries: Int
  private let state: Locked<State>

  init(_ folder: PlanFolder, jobs: Int, retries: Int, _ style: RunReporter.Style) {
    (self.folder, self.jobs, self.retries) = (folder, jobs, retries)
    state = Locked(State(reporter: PlanReporter(folder, style)))
  }

  /// Makes what is missing, stage by stage, as far as nothing fails that later stages need. Throws
  /// a `CommandFailure` after an interrupt.
  func run() async throws {
    let interrupts = InterruptHandler { stop() }
    for stage in folder.isComplete ? [] : folder.plan.stages {
      let missing = folder.missing(in: stage)
      state.withLock { state in
        state.open = missing.reversed()
        state.threads = max(1, ProcessorShare.current.threads / max(1, min(jobs, missing.count)))
      }
      try await withThrowingTaskGroup(of: Void.self) { group in
        for _ in 0..<jobs {
          group.addTask { while try await makeNext() {} }
        }
        try await group.waitForAll()
      }
      if interrupts.wasInterrupted { break }
      if !stage.isPartial, !folder.missing(in: stage).isEmpty { break }
    }
    state.withLock { $0.reporter.finish() }
    if interrupts.wasInterrupted { throw CommandFailure.interrupted(ChildResult.resumeHint) }
  }

  private func stop() {
    let runs = state.withLock { state in
      state.isStopped = true
      return Array(state.running.values)
    }
    runs.forEach { $0.stop() }
  }

  /// Makes a chunk; returns false if none is left.
  private func makeNext() async throws -> Bool {
    let next: (ChunkID, ChunkRun)? = state.withLock { state in
      guard !state.isStopped, let id = state.open.popLast() else { return nil }
      let run = ChunkRun(id, of: folder, threads: state.threads)
      state.running[id] = run
      state.attempts[id, default: 0] += 1
      return (id, run)
    }
    guard let (id, run) = next else { return false }
    let status = try await run.run { _ in update() }
    state.withLock { state in
      state.running[id] = nil
      if status.status == .failed, status.isTransient, state.attempts[id, default: 0] <= retries {
        state.open.insert(id, at: 0)
      }
    }
    update()
    return true
  }

  private func update() {
    state.withLock { $0.reporter.update(running: Set($0.running.keys)) }
  }
}

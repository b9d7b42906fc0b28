import Foundation
import SceneModel
import SharedCommands

/// Shows how far a plan on Slurm is, and submits what is next where no job does.
struct SlurmWatch {
  /// Time between two looks at the cluster, in seconds: `squeue` is a load for the controller.
  /// Chosen.
  private static let interval = 3.0
  /// How long a second interrupt is waited for, in seconds. Chosen.
  private static let secondChance = 5.0

  let run: SlurmRun
  let style: RunReporter.Style

  /// Returns once nothing more can be made, with the chunks that failed. Throws a `CommandFailure`
  /// after an interrupt, and if a job can't be submitted.
  func follow() async throws -> [ChunkID] {
    let isCanceled = Locked(false)
    let interrupts = InterruptHandler(
      message: "The jobs continue. Press Ctrl-C again within five seconds to cancel them.",
      onSecond: { isCanceled.withLock { $0 = true } }, {})
    if try run.jobs().isEmpty { run.forgetFailures() }
    var reporter = PlanReporter(run.folder, style)
    defer { reporter.finish() }
    while true {
      if interrupts.wasInterrupted {
        reporter.finish()
        try await leave { isCanceled.withLock { $0 } }
      }
      switch step(&reporter) {
      case .success(let failed?): return failed
      case .success(nil): break
      case .failure(let failure): guard failure.isTransient else { throw failure }
      }
      try? await sleep { interrupts.wasInterrupted }
    }
  }

  /// Looks at the cluster; returns the chunks that failed once nothing more can be made.
  private func step(_ reporter: inout PlanReporter) -> Result<[ChunkID]?, CommandFailure> {
    do {
      let jobs = try run.jobs()
      let active = run.active(jobs)
      reporter.update(
        running: Set(active.filter { $0.value.isRunning }.keys), note: Self.note(jobs))
      guard jobs.isEmpty, case .ended(let failed) = try run.advance() else {
        return .success(nil)
      }
      reporter.update(running: [])
      return .success(failed)
    } catch {
      let failure = CommandFailure(error)
      reporter.update(running: [], note: failure.sentence)
      return .failure(failure)
    }
  }

  /// Why jobs wait, if none runs.
  private static func note(_ jobs: [Slurm.Job]) -> String {
    let reasons = Set(jobs.filter { $0.task != nil }.map(\.reason)).subtracting(["None", ""])
    guard !jobs.contains(where: \.isRunning), !reasons.isEmpty else { return "" }
    return "waiting: \(reasons.sorted().joined(separator: ", "))"
  }

  /// Ends the display after an interrupt; cancels the jobs after a second one.
  private func leave(isCanceled: () -> Bool) async throws -> Never {
    let end = ProcessInfo.processInfo.systemUptime + Self.secondChance
    while !isCanceled(), ProcessInfo.processInfo.systemUptime < end {
      try await Task.sleep(for: .milliseconds(50))
    }
    guard isCanceled() else {
      throw CommandFailure.interrupted(
        "The jobs continue; run the same command again to see their progress.")
    }
    try run.cancel()
    throw CommandFailure.interrupted(
      "The jobs are canceled. What is done is kept; run the same command again to resume.")
  }

  /// Waits until it is time to look again, or until an interrupt.
  private func sleep(isInterrupted: () -> Bool) async throws {
    let end = ProcessInfo.processInfo.systemUptime + Self.interval
    while !isInterrupted(), ProcessInfo.processInfo.systemUptime < end {
      try await Task.sleep(for: .milliseconds(100))
    }
  }
}

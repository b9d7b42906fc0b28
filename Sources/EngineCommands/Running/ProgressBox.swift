import SceneModel
import SharedCommands

/// A reporter of one stage that any thread may use.
final class ProgressBox: Sendable {
  private let reporter: Locked<RunReporter>
  private let stage: RunStage

  init(_ reporter: RunReporter, stage: RunStage) {
    self.reporter = Locked(reporter)
    self.stage = stage
  }

  /// Shows the fraction of the stage that is done, 0…1.
  func update(_ fraction: Double) {
    reporter.withLock { $0.update(RunProgress(fraction: fraction, stage: stage)) }
  }

  func finish() { reporter.withLock { $0.finish() } }
}

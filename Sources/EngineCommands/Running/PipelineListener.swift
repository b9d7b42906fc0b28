import Logging
import Pipeline
import SceneModel
import SharedCommands

/// Shows the progress of a pipeline and logs its messages; safe to call from any thread.
final class PipelineListener: Sendable {
  private struct State {
    var reporter: RunReporter
    var tracker: RunProgressTracker
  }

  private let state: Locked<State>
  private let logsDetails: Bool
  private let triangulates: Bool
  private let logger = Logger(label: "photogrammetry-cli")

  /// `stages` are in the order of work; with `logsDetails` details are logged without `--verbose`,
  /// too.
  init(
    _ reporter: RunReporter, stages: [PipelineStage], coarserModels: [DetailSpecification] = [],
    durations: StageDurationModel, logsDetails: Bool = false
  ) {
    let tracker = RunProgressTracker(
      stages: stages, coarserModels: coarserModels, durations: durations, at: reporter.elapsed)
    state = Locked(State(reporter: reporter, tracker: tracker))
    triangulates = durations.alignment != .search
    self.logsDetails = logsDetails
  }

  /// Shows or logs an event.
  func receive(_ event: PipelineEvent) {
    state.withLock { state in
      guard let progress = state.tracker.update(event, at: state.reporter.elapsed) else { return }
      state.reporter.update(
        RunProgress(
          fraction: progress.fraction, stage: shown(progress.stage),
          remaining: progress.remainingSeconds))
    }
    switch event {
    case .rejected(let photo): logger.warning("\(photo.reason)")
    case .warning(let sentence): logger.warning("\(sentence)")
    case .detail(let sentence): logger.log(level: logsDetails ? .info : .debug, "\(sentence)")
    default: break
    }
  }

  private func shown(_ stage: PipelineStage) -> RunStage? {
    stage == .imageAlignment && triangulates ? .triangulation : RunStage(rawValue: stage.rawValue)
  }

  /// Removes the progress bar.
  func finish() { state.withLock { $0.reporter.finish() } }
}

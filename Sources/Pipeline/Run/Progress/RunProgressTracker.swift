/// Tracks the events of a run that passes through its stages once, for a command that shows the
/// progress of a single result.
package struct RunProgressTracker: Sendable {
  /// The state of the run after an event.
  package struct Progress: Hashable, Sendable {
    package var stage: PipelineStage
    /// The completed fraction of all stages, from 0 to 1.
    package var fraction: Double
    /// Nil before anything is measured.
    package var remainingSeconds: Double?
  }

  private let units: [WorkUnit]
  private var durations: StageDurationModel
  private var estimator: ProgressEstimator

  /// `stages` are in the order of work; `time` is in seconds of any monotonic clock.
  package init(stages: [PipelineStage], durations: StageDurationModel, at time: Double) {
    units = stages.map { WorkUnit(stage: $0) }
    self.durations = durations
    estimator = ProgressEstimator(units: units, at: time) { durations.seconds(of: $0) }
  }

  /// The progress after an event; nil if the event does not change it.
  package mutating func update(_ event: PipelineEvent, at time: Double) -> Progress? {
    switch event {
    case .ingested(let photos):
      durations.photos = photos
      estimator.reweigh { [durations] in durations.seconds(of: $0) }
      return nil
    case .progress(let stage, let fraction):
      let unit = WorkUnit(stage: stage)
      guard units.contains(unit) else { return nil }
      estimator.advance(unit, to: fraction, at: time)
      return Progress(
        stage: stage, fraction: estimator.fraction(of: units),
        remainingSeconds: estimator.remainingSeconds(of: units))
    case .extended(let stage, let factor):
      estimator.extend(WorkUnit(stage: stage), by: factor)
      return nil
    case .rejected, .downsampled, .stitchingIncomplete, .warning, .detail:
      return nil
    }
  }
}

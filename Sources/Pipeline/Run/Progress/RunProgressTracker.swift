/// Tracks the events of a run for a command that shows its progress as a whole. The run passes
/// through its stages once, except that it may make several models one after the other.
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
  /// The models that are not made yet, the current one first; nil is the finest one.
  private var models: [DetailSpecification?]
  /// Whether the current model is being written.
  private var isWriting = false

  /// `stages` are in the order of work, those of the model after those that all models share;
  /// `coarserModels` are made before the model of `durations.finest`. `time` is in seconds of any
  /// monotonic clock.
  package init(
    stages: [PipelineStage], coarserModels: [DetailSpecification] = [],
    durations: StageDurationModel, at time: Double
  ) {
    let models = coarserModels + [DetailSpecification?.none]
    var seen: Set<WorkUnit> = []
    units = models.flatMap { model in stages.map { WorkUnit(stage: $0, specification: model) } }
      .filter { seen.insert($0).inserted }
    self.models = models
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
      let unit = unit(of: stage)
      guard units.contains(unit) else { return nil }
      estimator.advance(unit, to: fraction, at: time)
      return Progress(
        stage: stage, fraction: estimator.fraction(of: units),
        remainingSeconds: estimator.remainingSeconds(of: units))
    case .extended(let stage, let factor):
      estimator.extend(unit(of: stage), by: factor)
      return nil
    case .rejected, .downsampled, .stitchingIncomplete, .warning, .detail:
      return nil
    }
  }

  /// The unit of a stage that is at work. A model is textured after the preceding one was written.
  private mutating func unit(of stage: PipelineStage) -> WorkUnit {
    if stage == .textureMapping, isWriting, models.count > 1 {
      models.removeFirst()
      isWriting = false
    }
    if stage == .optimization { isWriting = true }
    return WorkUnit(stage: stage, specification: models[0])
  }
}

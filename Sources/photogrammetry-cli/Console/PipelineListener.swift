#if canImport(Pipeline)
  import Logging
  import Pipeline
  import SceneModel

  /// Shows the progress of a pipeline and logs what happens on the way; any thread may call it.
  final class PipelineListener: Sendable {
    /// A stage of the pipeline as the command shows it.
    struct Stage {
      var stage: PipelineStage
      var shown: RunStage
      /// Of the command's time, usually.
      var share: Double

      init(_ stage: PipelineStage, as shown: RunStage, share: Double) {
        (self.stage, self.shown, self.share) = (stage, shown, share)
      }
    }

    private let reporter: Locked<RunReporter>
    private let stages: [Stage]
    private let tellsDetails: Bool
    private let logger = Logger(label: "photogrammetry-cli")

    /// `stages` are in their order; with `tellsDetails` their details are for everybody.
    init(_ reporter: RunReporter, stages: [Stage], tellsDetails: Bool = false) {
      self.reporter = Locked(reporter)
      self.stages = stages
      self.tellsDetails = tellsDetails
    }

    func take(_ event: PipelineEvent) {
      switch event {
      case .progress(let stage, let fraction): show(stage, fraction)
      case .refused(let photo): logger.warning("\(photo.reason)")
      case .warning(let sentence): logger.warning("\(sentence)")
      case .detail(let sentence): logger.log(level: tellsDetails ? .info : .debug, "\(sentence)")
      default: break
      }
    }

    private func show(_ stage: PipelineStage, _ fraction: Double) {
      guard let index = stages.firstIndex(where: { $0.stage == stage }) else { return }
      let before = stages[..<index].reduce(0) { $0 + $1.share }
      let done = before + stages[index].share * fraction
      reporter.withLock { reporter in
        let elapsed = reporter.elapsed
        let remaining = done > 0.1 ? elapsed / done * (1 - done) : nil
        reporter.update(
          RunProgress(fraction: done, stage: stages[index].shown, remaining: remaining))
      }
    }

    func finish() { reporter.withLock { $0.finish() } }
  }
#endif

import Foundation
import Logging

/// The state of a run, from the outputs of its session.
struct SessionRun<Engine: EngineSupport> {
  private let files: ReconstructionFiles
  private var reporter: RunReporter
  private var progress = RunProgress()
  private let logger = Logger(label: "photogrammetry-cli")
  /// Why requests failed; each sentence once.
  private(set) var failures: [String] = []
  /// Whether another attempt may succeed after one of the failures.
  private(set) var isTransient = false
  private(set) var isCancelled = false

  init(files: ReconstructionFiles, reporter: RunReporter) {
    (self.files, self.reporter) = (files, reporter)
  }

  /// Records an output, writes its result, and returns whether it is the last one.
  mutating func isLast(_ output: PhotogrammetrySession.Output) throws -> Bool {
    switch output {
    case .requestProgress(let request, let fraction):
      if isModel(request) {
        progress.fraction = fraction
        reporter.update(progress)
      }
    case .requestProgressInfo(let request, let info):
      if isModel(request) {
        progress.stage = info.processingStage.flatMap(RunStage.init) ?? progress.stage
        progress.remaining = info.estimatedRemainingTime
        reporter.update(progress)
      }
    case .requestComplete(_, let result):
      do {
        try files.store(result, reporter, intrinsics: Engine.intrinsics)
      } catch {
        failures.append(CommandFailure(error).sentence)
      }
    case .requestError(_, let error):
      let sentence = CommandFailure(error).sentence
      isTransient = isTransient || Engine.isTransient(error)
      if !failures.contains(sentence) { failures.append(sentence) }
    case .processingComplete: return true
    case .processingCancelled:
      isCancelled = true
      return true
    default: report(output)
    }
    return false
  }

  private func report(_ output: PhotogrammetrySession.Output) {
    switch output {
    case .inputComplete:
      reporter.event(RunEvent("inputComplete"))
    case .invalidSample(let id, let reason):
      warn("Photo \(id) is not used: \(reason)")
      reporter.event(RunEvent("invalidSample") { ($0.sample, $0.reason) = (id, reason) })
    case .skippedSample(let id):
      warn("Photo \(id) could not be registered.")
      reporter.event(RunEvent("skippedSample") { $0.sample = id })
    case .automaticDownsampling:
      warn("Photos are used at a lower resolution to fit the memory.")
      reporter.event(RunEvent("automaticDownsampling"))
    case .stitchingIncomplete:
      warn("Only some of the photos could be registered.")
      reporter.event(RunEvent("stitchingIncomplete"))
    default: break
    }
  }

  /// Logs a warning, unless the session has logged the same.
  private func warn(_ sentence: String) {
    if Engine.sessionOutputSource == nil { logger.warning("\(sentence)") }
  }

  /// Whether the request is that of the model that is made last, whose progress is that of the run.
  private func isModel(_ request: PhotogrammetrySession.Request) -> Bool {
    if case .modelFile(let url, _, _) = request { url == files.output.url } else { false }
  }
}

extension RunStage {
  init?(_ stage: PhotogrammetrySession.Output.ProcessingStage) {
    switch stage {
    case .preProcessing: self = .preProcessing
    case .imageAlignment: self = .imageAlignment
    case .pointCloudGeneration: self = .pointCloudGeneration
    case .meshGeneration: self = .meshGeneration
    case .textureMapping: self = .textureMapping
    case .optimization: self = .optimization
    @unknown default: return nil
    }
  }
}

import Foundation
import Formats
import Logging
import RealityKit
import SceneModel

/// Carries out `reconstruct`: builds the session and its requests and follows the outputs.
struct ReconstructionJob {
  private typealias Request = PhotogrammetrySession.Request

  private let input: URL
  private let output: ModelOutput
  private let arguments: Reconstruct
  private let posesURL: URL?
  private let pointCloudURL: URL?
  private let reportURL: URL?
  private let previewURL: URL?
  private let checkpointURL: URL?
  private let logger = Logger(label: "photogrammetry-cli")

  /// Checks all paths; throws a `CommandFailure`.
  init(_ arguments: Reconstruct) throws {
    self.arguments = arguments
    input = try PhotoFolderArgument(arguments.inputFolder).url
    output = try ModelOutput(arguments.output)
    func url(_ path: String?) throws -> URL? {
      let url = path.map { URL(fileURLWithPath: $0, isDirectory: false) }
      if let url { try ModelOutput.checkWritable(url) }
      return url
    }
    posesURL = try url(arguments.poses)
    pointCloudURL = try url(arguments.pointCloud)
    reportURL = try url(arguments.engine.report)
    previewURL = try arguments.preview.file()
    checkpointURL = try arguments.checkpointDirectory.map { path in
      let url = URL(fileURLWithPath: path, isDirectory: true)
      try ModelOutput.checkWritable(url)
      return url
    }
  }

  /// Runs to the end; throws a `CommandFailure` when something asked for was not made.
  func run(_ reporter: RunReporter) async throws {
    guard PhotogrammetrySession.isSupported else {
      throw unsupportedMachine
    }
    ConsoleLogHandler.hidesSessionErrors.store(true, ordering: .relaxed)
    let session = try PhotogrammetrySession(input: input, configuration: configuration)
    try arguments.engine.configure(session, photos: input)
    try arguments.preview.configure(session)
    arguments.surface.configure(session)
    let cancellable = Cancellable(session: session)
    let interrupts = InterruptHandler(untilInputEnds: arguments.untilInputEnds) {
      cancellable.session.cancel()
    }
    var run = Run(job: self, reporter: reporter)
    do {
      try session.process(requests: requests)
      for try await output in session.outputs {
        if try run.take(output) { break }
      }
    } catch {
      reporter.finish()
      throw interrupts.wasInterrupted ? interrupted : error
    }
    reporter.finish()
    try writeReport(of: session, reporter)
    if run.isCancelled { throw interrupted }
    if let failure = run.failures.first {
      for sentence in run.failures.dropFirst() { logger.error("\(sentence)") }
      throw CommandFailure.run(failure, mayPass: run.mayPass)
    }
    reporter.event(summary(of: session, reporter))
    logger.info("Done in \(RunProgress.duration(reporter.elapsed)).")
  }

  private var interrupted: CommandFailure {
    let rest = checkpointURL.map { " Finished stages are in \($0.path)." } ?? ""
    return CommandFailure(
      sentence: "Interrupted; no model was written.\(rest)",
      exitCode: CommandFailure.interruptedCode)
  }

  private var configuration: PhotogrammetrySession.Configuration {
    var configuration = PhotogrammetrySession.Configuration()
    configuration.isObjectMaskingEnabled = !arguments.noObjectMasking
    configuration.sampleOrdering = arguments.alignment.sampleOrdering.ordering
    configuration.featureSensitivity = arguments.alignment.featureSensitivity.sensitivity
    configuration.checkpointDirectory = checkpointURL
    configuration.customDetailSpecification = arguments.detail.specification
    configuration.meshPrimitive = arguments.shape.primitive
    return configuration
  }

  private var requests: [PhotogrammetrySession.Request] {
    var requests = [
      Request.modelFile(
        url: output.url, detail: arguments.detail.detail.detail, geometry: arguments.shape.geometry)
    ]
    if posesURL != nil { requests.append(.poses) }
    if pointCloudURL != nil { requests.append(.pointCloud) }
    return requests
  }

  private func summary(
    of session: PhotogrammetrySession, _ reporter: RunReporter
  ) -> RunEvent {
    var event = RunEvent(event: "complete", seconds: reporter.elapsed)
    engineCounts(of: session, into: &event)
    return event
  }

  private func writeReport(
    of session: PhotogrammetrySession, _ reporter: RunReporter
  ) throws {
    guard let reportURL, let data = try arguments.engine.reportData(of: session) else { return }
    try AtomicFile.write(data, to: reportURL)
    reporter.wrote("report", reportURL.relativePath)
  }

  /// Stores what a request gave.
  fileprivate func store(
    _ result: PhotogrammetrySession.Result, _ reporter: RunReporter
  ) throws {
    switch result {
    case .modelFile(let url):
      reporter.wrote("model", url.relativePath)
      if let previewURL { reporter.wrote("preview", previewURL.relativePath) }
    case .poses(let poses):
      guard let posesURL else { return }
      try AtomicFile.write(try PosesFile(poses).encoded(), to: posesURL)
      reporter.wrote("poses", posesURL.relativePath)
    case .pointCloud(let cloud):
      guard let pointCloudURL else { return }
      let points = SceneModel.PointCloud(
        positions: cloud.points.map(\.position),
        colors: cloud.points.map { [$0.color.x, $0.color.y, $0.color.z] })
      try PLY.write(points, to: pointCloudURL)
      reporter.wrote("pointCloud", pointCloudURL.relativePath)
    default: break
    }
  }

  fileprivate func warn(_ sentence: String) {
    if !sessionLogsItsOutputs { logger.warning("\(sentence)") }
  }
}

/// A session that is safe to cancel from any thread, even if its type doesn't say so.
private struct Cancellable: @unchecked Sendable {
  let session: PhotogrammetrySession
}

/// What is known of a run while its outputs come in.
private struct Run {
  let job: ReconstructionJob
  var reporter: RunReporter
  var progress = RunProgress()
  var failures: [String] = []
  /// Whether the cause of a failure may be gone at another time.
  var mayPass = false
  var isCancelled = false

  init(job: ReconstructionJob, reporter: RunReporter) {
    self.job = job
    self.reporter = reporter
  }

  /// Takes in one output and says whether it was the last.
  mutating func take(_ output: PhotogrammetrySession.Output) throws -> Bool {
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
        try job.store(result, reporter)
      } catch {
        failures.append(sentence(for: error))
      }
    case .requestError(_, let error):
      let sentence = sentence(for: error)
      mayPass = mayPass || photogrammetry_cli.mayPass(error)
      if !failures.contains(sentence) { failures.append(sentence) }
    case .processingComplete: return true
    case .processingCancelled:
      isCancelled = true
      return true
    default: tell(output)
    }
    return false
  }

  private func tell(_ output: PhotogrammetrySession.Output) {
    switch output {
    case .inputComplete:
      reporter.event(RunEvent(event: "inputComplete"))
    case .invalidSample(let id, let reason):
      job.warn("Photo \(id) is not used: \(reason)")
      reporter.event(RunEvent(event: "invalidSample", sample: id, reason: reason))
    case .skippedSample(let id):
      job.warn("Photo \(id) could not be placed.")
      reporter.event(RunEvent(event: "skippedSample", sample: id))
    case .automaticDownsampling:
      job.warn("Photos are used at a lower resolution to fit the memory.")
      reporter.event(RunEvent(event: "automaticDownsampling"))
    case .stitchingIncomplete:
      job.warn("Only some of the photos could be put together.")
      reporter.event(RunEvent(event: "stitchingIncomplete"))
    default: break
    }
  }

  private func isModel(_ request: PhotogrammetrySession.Request) -> Bool {
    if case .modelFile = request { true } else { false }
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

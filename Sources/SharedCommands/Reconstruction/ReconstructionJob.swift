import Formats
import Foundation
import Logging
import SceneModel

/// Carries out `reconstruct`: sets up the session and its requests, follows its outputs and writes
/// their results.
struct ReconstructionJob<Engine: EngineSupport> {
  private let arguments: ReconstructArguments<Engine.Arguments>
  private let files: ReconstructionFiles
  private let logger = Logger(label: "photogrammetry-cli")

  /// Checks all paths; throws a `CommandFailure`.
  init(_ arguments: ReconstructArguments<Engine.Arguments>) throws {
    self.arguments = arguments
    files = try ReconstructionFiles(
      arguments, input: Engine.input(arguments.inputFolder), formats: Engine.modelFormats)
  }

  /// Runs to the end; throws a `CommandFailure` if a requested result is missing or suspect.
  func run(_ reporter: RunReporter) async throws {
    guard PhotogrammetrySession.isSupported else { throw Engine.unsupportedMachine }
    let photos = try photoFolder(reporter)
    if try await Engine.runInstead(
      arguments, photos: photos.url, output: files.output, reporter)
    {
      return
    }
    ConsoleLogHandler.hidesSessionErrors.store(true, ordering: .relaxed)
    let session = try PhotogrammetrySession(
      input: photos.url, configuration: arguments.sessionConfiguration)
    try arguments.engine.configure(session, photos: photos.url)
    var run = SessionRun<Engine>(files: files, reporter: reporter)
    do {
      try await follow(session, &run)
    } catch {
      reporter.finish()
      throw error
    }
    reporter.finish()
    try writeFiles(of: session, reporter)
    if run.isCancelled { throw interrupted }
    if let failure = run.failures.first {
      for sentence in run.failures.dropFirst() { logger.error("\(sentence)") }
      throw CommandFailure.run(failure, isTransient: run.isTransient)
    }
    if let concern = Engine.concerns(about: session).last {
      throw CommandFailure.run("The model was written, but it may not show the object. \(concern)")
    }
    reporter.event(
      RunEvent("complete") { event in
        event.seconds = reporter.elapsed
        Engine.addCounts(of: session, to: &event)
      })
    logger.info("Done in \(RunProgress.duration(reporter.elapsed)).")
  }

  /// The folder of the photos, made of a video if there is one.
  private func photoFolder(_ reporter: RunReporter) throws -> InputPhotos {
    switch files.input {
    case .folder(let url): InputPhotos(url)
    case .video(let url): try Engine.photos(of: url, arguments, reporter)
    }
  }

  /// Processes the requests and records all outputs; throws if an interrupt ended the session.
  private func follow(_ session: PhotogrammetrySession, _ run: inout SessionRun<Engine>)
    async throws
  {
    let cancellable = Cancellable(session: session)
    let interrupts = InterruptHandler(untilInputEnds: arguments.untilInputEnds) {
      cancellable.session.cancel()
    }
    do {
      try session.process(requests: requests)
      // An interrupt before this point had nothing to cancel.
      if interrupts.wasInterrupted { session.cancel() }
      for try await output in session.outputs {
        if try run.isLast(output) { break }
      }
    } catch {
      throw interrupts.wasInterrupted ? interrupted : error
    }
  }

  private var interrupted: CommandFailure {
    let rest = files.checkpoint.map { " Finished stages are in \($0.path)." } ?? ""
    let missing = files.coarserModels.isEmpty ? "no" : "not every"
    return .interrupted("Interrupted; \(missing) model was written.\(rest)")
  }

  private var requests: [PhotogrammetrySession.Request] {
    let models =
      files.coarserModels.map { ($0.output, $0.level.requestDetail) }
      + [(files.output, arguments.detail.detail.requestDetail)]
    var requests = models.map { output, detail in
      PhotogrammetrySession.Request.modelFile(
        url: output.url, detail: detail, geometry: arguments.shape.geometry)
    }
    if files.poses != nil { requests.append(.poses) }
    if files.pointCloud != nil { requests.append(.pointCloud) }
    return requests
  }

  /// Writes what the engine makes of the run.
  private func writeFiles(of session: PhotogrammetrySession, _ reporter: RunReporter) throws {
    let photos =
      switch files.input {
      case .folder(let url), .video(let url): url
      }
    for file in try arguments.engine.files(of: session, photos: photos, model: files.output) {
      try AtomicFile.write(file.content, to: file.url)
      reporter.wrote(file.kind, file.url.relativePath)
    }
  }
}

/// A session whose `cancel()` is safe on any thread, even if its type isn't `Sendable`.
private struct Cancellable: @unchecked Sendable {
  let session: PhotogrammetrySession
}

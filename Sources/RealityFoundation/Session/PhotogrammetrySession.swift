import Pipeline
import SceneModel

/// Makes 3-D models from photos of an object.
///
/// Create a session with the photos' folder, pass it requests and follow `outputs`:
///
/// ```swift
/// let photos = URL(fileURLWithPath: "photos", isDirectory: true)
/// let session = try PhotogrammetrySession(input: photos)
/// try session.process(requests: [.modelFile(url: URL(fileURLWithPath: "model.usdz"))])
/// for try await output in session.outputs {
///   if case .processingComplete = output { break }
/// }
/// ```
///
/// The work is done on a thread of the session. The session stays alive while it works, even if
/// nothing refers to it. It may be used from any thread.
public class PhotogrammetrySession: @unchecked Sendable {
  /// How the session processes its photos.
  public let configuration: Configuration

  /// Options of this engine beyond the configuration; set them before the first `process`.
  package var engineOptions: EngineOptions {
    get { options.withLock { $0 } }
    set { options.withLock { $0 = newValue } }
  }

  /// The configuration of the engine that processes requests. Throws if an override is not valid.
  package var pipelineConfiguration: PipelineConfiguration {
    get throws { try PipelineConfiguration(session: configuration, engineOptions) }
  }

  private let options = Locked(EngineOptions())
  private let identity = UUID()
  private let worker: any SessionWorker

  init(_ worker: any SessionWorker, configuration: Configuration) {
    self.worker = worker
    self.configuration = configuration
  }

  deinit { worker.close() }

  /// Whether this machine can make models: it needs enough memory and a suitable processor. What is
  /// missing is logged.
  public static var isSupported: Bool {
    let shortfalls = Machine.current.shortfalls
    for sentence in shortfalls { sessionLogger.error("\(sentence)") }
    return shortfalls.isEmpty
  }

  /// The outputs of the session, from its beginning to its end.
  public var outputs: Outputs { Outputs(buffer: worker.outputs) }

  /// Whether requests are being processed.
  public var isProcessing: Bool { worker.isProcessing }

  /// The requests that are being processed.
  public var activeRequests: [Request] { worker.activeRequests }

  /// Starts to process requests and returns immediately; results are delivered by `outputs`.
  ///
  /// Throws `Error.invalidImages` if the photos don't exist, `Error.invalidOutput` or
  /// `Error.insufficientStorage` if the output of a request can't be written, and an error with a
  /// remedy if a request is invalid or the session is processing already. A later call reuses the
  /// results of earlier ones.
  public func process(requests: [Request]) throws {
    try worker.process(requests, options: engineOptions, keepingAlive: self)
  }

  /// Requests the end of processing; `processingCancelled` follows. Has no effect when nothing is
  /// being processed.
  public func cancel() { worker.cancel() }

  /// The report of the run so far; nil before the first request ends.
  package var report: RunReport? { worker.report }

  /// What the page of the report shows besides it; nil unless the options ask for it.
  package var reportMaterial: ReportMaterial? { worker.reportMaterial }
}

extension PhotogrammetrySession: Identifiable {
  /// Identifies the session.
  public var id: UUID { identity }
}

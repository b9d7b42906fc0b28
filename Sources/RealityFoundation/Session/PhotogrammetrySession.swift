import Pipeline
import SceneModel

/// Makes 3-D models from photos of an object.
///
/// Create a session with the folder of the photos, submit requests and iterate over `outputs`:
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
/// The session works on a thread of its own and stays alive while it works, even if nothing refers
/// to it. It may be used from any thread.
public class PhotogrammetrySession: @unchecked Sendable {
  /// How the session processes its photos.
  public let configuration: Configuration

  /// Engine options beyond the configuration; set them before the first `process`.
  package var engineOptions: EngineOptions {
    get { options.withLock { $0 } }
    set { options.withLock { $0 = newValue } }
  }

  private let options = Locked(EngineOptions())
  private let identity = UUID()
  let input: SessionInput
  let core: SessionCore

  /// Creates a session for the photos in a folder.
  ///
  /// Throws `Error.invalidImages` if the folder can't be read or is empty.
  public convenience init(input: URL, configuration: Configuration = Configuration()) throws {
    guard InputFolder(input).isUsable else { throw Error.invalidImages(input) }
    self.init(.folder(input), configuration: configuration)
  }

  /// Creates a session for a sequence of samples. It is iterated once, and each sample is requested
  /// when it is read.
  ///
  /// The iteration runs on the session's thread after `process` was called. A lazy sequence must
  /// not consist of closures isolated to the main actor, as closures in a program's `main` are in
  /// Swift 6.
  public convenience init<S>(
    input: S, configuration: Configuration = Configuration()
  ) throws where S: Sequence, S.Element == PhotogrammetrySample {
    self.init(.samples(SampleFolder(input)), configuration: configuration)
  }

  init(
    _ input: SessionInput, configuration: Configuration,
    makeEngine: @escaping SessionCore.EngineFactory = ReconstructionEngine.make
  ) {
    self.input = input
    self.configuration = configuration
    core = SessionCore(makeEngine: makeEngine)
  }

  deinit { core.close() }

  /// Whether this machine can make models: it needs enough memory and a supported CPU. What is
  /// missing is logged.
  public static var isSupported: Bool {
    let shortfalls = Machine.current.shortfalls
    for sentence in shortfalls { sessionLogger.error("\(sentence)") }
    return shortfalls.isEmpty
  }

  /// The outputs of the session over its whole lifetime.
  public var outputs: Outputs { Outputs(buffer: core.outputs) }

  /// Whether requests are being processed.
  public var isProcessing: Bool { core.isProcessing }

  /// The requests that are being processed.
  public var activeRequests: [Request] { core.activeRequests }

  /// Starts processing requests and returns immediately; results arrive as `outputs`.
  ///
  /// Throws if the session is already processing, the photos no longer exist, or the output of a
  /// request can't be written. A later call reuses the intermediate results of earlier ones.
  public func process(requests: [Request]) throws {
    try RequestValidation(
      input: input, configuration: configuration, options: engineOptions
    ).check(requests)
    try core.process(
      EngineTask(
        input: input, configuration: configuration, options: engineOptions,
        plan: RunPlan(requests, configuration: configuration)),
      keepingAlive: self)
  }

  /// Requests cancellation; `processingCancelled` follows. Has no effect if nothing is being
  /// processed.
  public func cancel() { core.cancel() }

  /// What the run has done so far, by stage and by photo; nil until the first request has ended.
  package var report: RunReport? { core.report }
}

extension PhotogrammetrySession: Identifiable {
  /// The identity of the session.
  public var id: UUID { identity }
}

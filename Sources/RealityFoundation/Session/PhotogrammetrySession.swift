import Pipeline
import SceneModel

/// Makes 3-D models from photos of an object.
///
/// Create a session with the photos' folder, hand it requests and follow `outputs`:
///
/// ```swift
/// let session = try PhotogrammetrySession(input: URL(fileURLWithPath: "photos", isDirectory: true))
/// try session.process(requests: [.modelFile(url: URL(fileURLWithPath: "model.usdz"))])
/// for try await output in session.outputs {
///   if case .processingComplete = output { break }
/// }
/// ```
///
/// The work is done on a thread of the session's own. The session stays alive while it works, even
/// when nothing refers to it. It may be used from any thread.
public class PhotogrammetrySession: @unchecked Sendable {
  /// How the session treats its photos.
  public let configuration: Configuration

  /// What our engine is told beyond the configuration; set it before the first `process`.
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
  /// Throws `Error.invalidImages` when the folder can't be read or is empty.
  public convenience init(input: URL, configuration: Configuration = Configuration()) throws {
    guard InputFolder(input).isUsable else { throw Error.invalidImages(input) }
    self.init(.folder(input), configuration: configuration)
  }

  /// Creates a session for a sequence of samples, which is gone through once, sample by sample as they
  /// are read.
  ///
  /// That happens on a thread of the session's own, after `process` was called. A lazy sequence of
  /// closures must not belong to the main actor, as closures in a program's `main` do in Swift 6.
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

  /// Whether this machine can make models: it needs enough memory and a suitable processor. What
  /// is missing is logged.
  public static var isSupported: Bool {
    let shortfalls = Machine.current.shortfalls
    for sentence in shortfalls { sessionLogger.error("\(sentence)") }
    return shortfalls.isEmpty
  }

  /// What the session tells, from its beginning to its end.
  public var outputs: Outputs { Outputs(buffer: core.outputs) }

  /// Whether requests are being worked on.
  public var isProcessing: Bool { core.isProcessing }

  /// The requests that are being worked on.
  public var activeRequests: [Request] { core.activeRequests }

  /// Begins to work on requests and returns at once; results come as `outputs`.
  ///
  /// Throws when the session is processing already, the photos are gone, or a request can't be met
  /// for its output's sake. A later call uses again what an earlier one found out.
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

  /// Asks to stop; `processingCancelled` follows. Has no effect when nothing is being processed.
  public func cancel() { core.cancel() }

  /// What the run did so far, stage by stage and photo by photo; nil before the first request ends.
  package var report: RunReport? { core.report }
}

extension PhotogrammetrySession: Identifiable {
  /// A number of the session's own.
  public var id: UUID { identity }
}

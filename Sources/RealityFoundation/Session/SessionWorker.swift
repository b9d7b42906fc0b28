import Pipeline

/// Does the work of a session. May be used from any thread.
///
/// It does not refer to the session except while it works, so that an idle session is deallocated
/// when its owner drops it.
protocol SessionWorker: Sendable {
  typealias Request = PhotogrammetrySession.Request

  /// The session's outputs, from its beginning to its end.
  var outputs: OutputBuffer { get }
  var isProcessing: Bool { get }
  var activeRequests: [Request] { get }
  /// The run so far; nil before the first request ends.
  var report: RunReport? { get }

  /// Begins to work on requests and returns; `session` lives until the work has ended. Throws where a
  /// request can't be met, or work is in progress.
  func process(
    _ requests: [Request], options: EngineOptions, keepingAlive session: AnyObject) throws

  /// Requests the end of the work; without effect where there is none.
  func cancel()

  /// Ends the work and the outputs.
  func close()
}

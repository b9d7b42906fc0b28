import Pipeline

/// Does the work of a session; may be used from any thread.
///
/// It refers to the session only while it works, so that an idle session is deallocated when its
/// owner releases it.
protocol SessionWorker: Sendable {
  typealias Request = PhotogrammetrySession.Request

  /// The session's outputs, from its beginning to its end.
  var outputs: OutputBuffer { get }
  var isProcessing: Bool { get }
  var activeRequests: [Request] { get }
  /// The report of the run so far; nil before the first request ends.
  var report: RunReport? { get }
  /// What the page of the report shows besides it; nil unless the options ask for it.
  var reportMaterial: ReportMaterial? { get }

  /// Starts to process requests and returns; `session` is kept alive until the work has ended.
  /// Throws if a request is invalid or work is in progress.
  func process(
    _ requests: [Request], options: EngineOptions, keepingAlive session: AnyObject) throws

  /// Requests the end of the work; has no effect if there is none.
  func cancel()

  /// Ends the work and the outputs.
  func close()
}

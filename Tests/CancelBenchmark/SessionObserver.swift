import RealityFoundation
import Synchronization

/// Observes a session from `process` until it ends.
final class SessionObserver: Sendable {
  enum Ending: Sendable { case complete, canceled, failed }

  private let current = Mutex("ingestion")

  /// The most recently reported stage.
  var stage: String { current.withLock { $0 } }

  /// Waits for the last output of the run.
  func ending(of outputs: PhotogrammetrySession.Outputs) async throws -> Ending {
    var hasFailed = false
    for try await output in outputs {
      switch output {
      case .requestProgressInfo(_, let info):
        if let stage = info.processingStage { current.withLock { $0 = "\(stage)" } }
      case .requestError(_, let error):
        print(error.localizedDescription)
        hasFailed = true
      case .processingComplete: return hasFailed ? .failed : .complete
      case .processingCancelled: return .canceled
      default: break
      }
    }
    return .failed
  }
}

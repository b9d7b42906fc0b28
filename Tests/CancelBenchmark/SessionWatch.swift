import RealityFoundation
import Synchronization

/// Listens to a session from `process` on until it ends.
final class SessionWatch: Sendable {
  enum Ending: Sendable { case complete, cancelled, failed }

  private let current = Mutex("ingestion")

  /// The stage that was told of last.
  var stage: String { current.withLock { $0 } }

  /// Waits for the last output of the session's task.
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
      case .processingCancelled: return .cancelled
      default: break
      }
    }
    return .failed
  }
}

import Kernels
import Pipeline

/// The reason why the engine failed: a code, a sentence and a remedy.
package struct ProcessingError: LocalizedError, CustomNSError, Equatable, Sendable {
  /// The kind of error.
  package enum Code: Int, Sendable {
    case unknown = 0
    case alreadyProcessing, invalidRequest, emptyCrop, invalidInput, tooFewPhotos
    case alignmentFailed, noSurface, checkpointUnusable, outputFailed
    case outOfMemory
  }

  /// The domain of the `NSError`.
  package static let errorDomain = "RealityFoundation.PhotogrammetrySession.ProcessingError"

  /// The kind of error.
  package var code: Code
  /// What is wrong.
  package var reason: String
  /// What to do about it.
  package var remedy: String

  /// The code of the `NSError`.
  package var errorCode: Int { code.rawValue }
  /// The user info of the `NSError`: the localized description.
  package var errorUserInfo: [String: Any] { [NSLocalizedDescriptionKey: "\(reason) \(remedy)"] }
  /// The reason and the remedy.
  package var errorDescription: String? { "\(reason) \(remedy)" }
  /// What is wrong.
  package var failureReason: String? { reason }
  /// What to do about it.
  package var recoverySuggestion: String? { remedy }
}

extension ProcessingError: CustomStringConvertible {
  /// The reason and the remedy.
  package var description: String { "\(reason) \(remedy)" }
}

extension ProcessingError {
  static let alreadyProcessing = ProcessingError(
    code: .alreadyProcessing, reason: "The session is still processing.",
    remedy: "Wait for processingComplete or processingCancelled, or make another session.")

  static func invalidRequest(_ reason: String, remedy: String) -> ProcessingError {
    ProcessingError(code: .invalidRequest, reason: reason, remedy: remedy)
  }

  /// Converts an engine error; errors of this type are kept.
  init(_ error: any Swift.Error) {
    switch error {
    case let error as ProcessingError:
      self = error
    case let error as PipelineError:
      self.init(
        code: Code(error), reason: error.errorDescription ?? "Processing failed.",
        remedy: error.recoverySuggestion ?? "Check the photos and try again.")
    case let error as CheckpointError:
      self.init(
        code: .checkpointUnusable, reason: error.errorDescription ?? "",
        remedy: error.recoverySuggestion ?? "")
    case KernelError.outOfMemory:
      self.init(
        code: .outOfMemory, reason: "There was not enough memory.",
        remedy: "Close other programs, or choose a lower detail level.")
    case let error as any LocalizedError:
      self.init(
        code: .unknown, reason: error.errorDescription ?? String(describing: error),
        remedy: error.recoverySuggestion ?? "")
    default:
      self.init(
        code: .unknown, reason: "Processing failed: \(error).",
        remedy: "Try other photos or another detail level.")
    }
  }
}

extension ProcessingError.Code {
  fileprivate init(_ error: PipelineError) {
    switch error {
    case .unreadableFolder, .noPhotos: self = .invalidInput
    case .tooFewPhotos, .tooFewCameras: self = .tooFewPhotos
    case .camerasDontFit: self = .alignmentFailed
    case .alignmentFailed: self = .alignmentFailed
    case .noSurface: self = .noSurface
    case .emptyCrop: self = .emptyCrop
    }
  }
}

/// The message of an error, with its remedy if it has one.
package func sentence(of error: any Swift.Error) -> String {
  switch error {
  case let error as ProcessingError: error.description
  case let error as PhotogrammetrySession.Error: error.localizedDescription
  case let error as any LocalizedError:
    [error.errorDescription, error.recoverySuggestion].compactMap { $0 }.joined(separator: " ")
  default: String(describing: error)
  }
}

import Kernels
import Pipeline

/// Why the engine could not do what it was asked: a code, a sentence and a remedy.
package struct ProcessingError: LocalizedError, CustomNSError, Equatable, Sendable {
  /// What kind of error it is.
  package enum Code: Int, Sendable {
    case unknown = 0
    case alreadyProcessing, invalidRequest, emptyCrop, invalidInput, tooFewPhotos
    case alignmentFailed, noSurface, checkpointUnusable, outputFailed
    case outOfMemory
  }

  package static let errorDomain = "RealityFoundation.PhotogrammetrySession.ProcessingError"

  package var code: Code
  /// What is wrong.
  package var reason: String
  /// What to do about it.
  package var remedy: String

  package var errorCode: Int { code.rawValue }
  package var errorUserInfo: [String: Any] { [NSLocalizedDescriptionKey: "\(reason) \(remedy)"] }
  package var errorDescription: String? { "\(reason) \(remedy)" }
  package var failureReason: String? { reason }
  package var recoverySuggestion: String? { remedy }
}

extension ProcessingError: CustomStringConvertible {
  package var description: String { "\(reason) \(remedy)" }
}

extension ProcessingError {
  static let alreadyProcessing = ProcessingError(
    code: .alreadyProcessing, reason: "The session is still processing.",
    remedy: "Wait for processingComplete or processingCancelled, or make another session.")

  static func invalidRequest(_ reason: String, remedy: String) -> ProcessingError {
    ProcessingError(code: .invalidRequest, reason: reason, remedy: remedy)
  }

  /// The engine's error in the session's words; errors of this type stay as they are.
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
        code: .outOfMemory, reason: "There was too little memory.",
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

/// What an error says, with its remedy where it has one.
package func sentence(of error: any Swift.Error) -> String {
  switch error {
  case let error as ProcessingError: error.description
  case let error as PhotogrammetrySession.Error: error.localizedDescription
  case let error as any LocalizedError:
    [error.errorDescription, error.recoverySuggestion].compactMap { $0 }.joined(separator: " ")
  default: String(describing: error)
  }
}

import Foundation

/// The reason why a result can't be compared.
package enum EvaluationError: LocalizedError, Equatable, Sendable {
  /// The reason completes a sentence that begins with the file's name.
  case invalidReference(String)
  /// No photo name occurs in both the result and the reference.
  case noCommonPhotos
  /// The common photos are too few or collinear.
  case undeterminedAlignment(commonPhotos: Int)
  case emptySurface

  package var errorDescription: String? {
    switch self {
    case .invalidReference(let reason): "The reference can't be used: \(reason)."
    case .noCommonPhotos: "The result and the reference have no photo name in common."
    case .undeterminedAlignment(let count):
      "The result can't be aligned to the reference: the \(count) common photos are too few or "
        + "collinear."
    case .emptySurface: "There is no surface to compare."
    }
  }
}

import ArgumentParser

/// The detail levels with fixed limits.
package enum DetailArgument: String, ExpressibleByArgument, CaseIterable, Sendable {
  case preview, reduced, medium, full, raw

  /// The level of a session's request.
  package var requestDetail: PhotogrammetrySession.Request.Detail {
    switch self {
    case .preview: .preview
    case .reduced: .reduced
    case .medium: .medium
    case .full: .full
    case .raw: .raw
    }
  }
}

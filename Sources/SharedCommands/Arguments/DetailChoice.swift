import ArgumentParser

/// A detail level, or custom limits.
package enum DetailChoice: ExpressibleByArgument, Equatable, Sendable {
  case level(DetailArgument)
  case custom

  /// Parses the name of a level, or `custom`.
  package init?(argument: String) {
    if argument == "custom" {
      self = .custom
    } else if let level = DetailArgument(rawValue: argument) {
      self = .level(level)
    } else {
      return nil
    }
  }

  package static let allValueStrings = DetailArgument.allCases.map(\.rawValue) + ["custom"]

  package var defaultValueDescription: String {
    switch self {
    case .level(let level): level.rawValue
    case .custom: "custom"
    }
  }

  /// The level of a session's request.
  package var requestDetail: PhotogrammetrySession.Request.Detail {
    switch self {
    case .level(let level): level.requestDetail
    case .custom: .custom
    }
  }
}

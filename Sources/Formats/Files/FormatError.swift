import Foundation

/// Why a file can't be read: a sentence with its path, and a remedy.
package enum FormatError: LocalizedError, Equatable, Sendable {
  case unreadable(path: String, reason: String)
  case malformed(path: String, reason: String)
  /// A valid file that this program can't read; `remedy` is a sentence.
  case unsupported(path: String, reason: String, remedy: String)

  package var errorDescription: String? {
    switch self {
    case .unreadable(let path, let reason): "\(path) can't be read: \(reason)."
    case .malformed(let path, let reason):
      "\(path) is damaged or has an unexpected format: \(reason)."
    case .unsupported(let path, let reason, _): "\(path) is not supported: \(reason)."
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .unreadable: "Check the path and its permissions."
    case .malformed: "Export the file again, or choose another one."
    case .unsupported(_, _, let remedy): remedy
    }
  }
}

import Foundation

/// Why a checkpoint directory can't be used: a sentence and a remedy.
package enum CheckpointError: LocalizedError, Equatable, Sendable {
  case inUse(directory: String)
  case notWritable(directory: String)

  package var errorDescription: String? {
    switch self {
    case .inUse(let directory): "Another run is using the checkpoint directory \(directory)."
    case .notWritable(let directory): "The checkpoint directory \(directory) can't be written to."
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .inUse: "Wait until it ends, or name another directory."
    case .notWritable: "Name a directory that you may write to, or change its permissions."
    }
  }
}

import Foundation

/// Why an output can't be written: a sentence with its path, and a remedy.
package enum OutputError: LocalizedError, Equatable, Sendable {
  case missingFolder(path: String, folder: String)
  case notWritable(path: String)
  case notAFolder(path: String)
  case isAFolder(path: String)
  case diskFull(path: String)
  case tooLarge(path: String, bytes: Int)
  case failed(path: String, reason: String)

  package var errorDescription: String? {
    switch self {
    case .missingFolder(let path, let folder):
      "\(path) can't be written: the folder \(folder) does not exist."
    case .notWritable(let path): "\(path) can't be written: permission denied."
    case .notAFolder(let path): "\(path) can't be written: a file with that name exists."
    case .isAFolder(let path): "\(path) can't be written: a folder with that name exists."
    case .diskFull(let path): "\(path) can't be written: the disk is full."
    case .tooLarge(let path, let bytes):
      "\(path) would have \(bytes) bytes; the format is limited to 4 GiB."
    case .failed(let path, let reason): "\(path) can't be written: \(reason)."
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .missingFolder(_, let folder): "Create it with: mkdir -p '\(folder)'"
    case .notWritable: "Choose a folder that you may write to, or change its permissions."
    case .notAFolder: "Remove that file or choose another name."
    case .isAFolder: "Choose another name."
    case .diskFull: "Free some space or choose another disk."
    case .tooLarge: "Choose a lower detail level or folder output."
    case .failed: "Check the path and the disk."
    }
  }
}

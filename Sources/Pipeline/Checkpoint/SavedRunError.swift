import Foundation

/// The reason why no models can be made from a checkpoint directory: a sentence and a remedy.
package enum SavedRunError: LocalizedError, Equatable, Sendable {
  case noDirectory(path: String)
  case noCheckpoint(directory: String)
  case unfinished(directory: String)
  case noRecord(path: String)
  case otherVersion(path: String, format: Int)
  /// The cameras and the surface come from different runs.
  case mixed(directory: String)
  case damaged(path: String, reason: String)
  case noPhotos(folder: String)
  case missingPhotos(folder: String, names: [String])
  case changedPhotos(folder: String, names: [String])

  package var errorDescription: String? {
    switch self {
    case .noDirectory(let path):
      "The folder \(path) does not exist."
    case .noCheckpoint(let directory):
      "\(directory) holds no checkpoint: sparse/images.txt is missing."
    case .unfinished(let directory):
      "The run in \(directory) has no finished surface: mesh/surface.ply is missing."
    case .noRecord(let path):
      "\(path) is missing: the run was interrupted, or made by an earlier version of this program."
    case .otherVersion(let path, let format):
      "\(path) was written by another version of this program: its format is \(format), not "
        + "\(SurfaceRecord.currentFormat)."
    case .mixed(let directory):
      "The cameras in \(directory)/sparse are not those that \(directory)/mesh was made with."
    case .damaged(let path, let reason):
      "\(path) can't be used: \(reason)."
    case .noPhotos(let folder):
      "The photos are gone: the folder \(folder) does not exist."
    case .missingPhotos(let folder, let names):
      "Photos are missing in \(folder): \(names.list())."
    case .changedPhotos(let folder, let names):
      "Photos in \(folder) have changed since the run: \(names.list())."
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .noDirectory, .noCheckpoint:
      "Specify the folder that was the --checkpoint-directory of a run."
    case .unfinished:
      "Repeat the run with the same --checkpoint-directory; the dense stage resumes where it "
        + "stopped."
    case .noRecord, .otherVersion, .mixed, .damaged:
      "Repeat the run with the same --checkpoint-directory."
    case .noPhotos, .missingPhotos:
      "Specify their current folder with --photos."
    case .changedPhotos:
      "Specify the folder of the originals with --photos, or repeat the run."
    }
  }
}

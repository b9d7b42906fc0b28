import Foundation

/// Why a run can't go on: a sentence and a remedy.
package enum PipelineError: LocalizedError, Equatable, Sendable {
  case unreadableFolder(path: String, reason: String)
  case noPhotos(folder: String, refused: Int)
  case tooFewPhotos(found: Int, needed: Int)
  case alignmentFailed(reason: String)
  case noSurface(reason: String)

  package var errorDescription: String? {
    switch self {
    case .unreadableFolder(let path, let reason):
      "\(path) can't be read: \(reason)."
    case .noPhotos(let folder, let refused):
      refused == 0
        ? "\(folder) holds no photos."
        : "\(folder) holds no usable photo; \(refused) files were refused."
    case .tooFewPhotos(let found, let needed):
      "Only \(found) usable photos; a reconstruction needs at least \(needed)."
    case .alignmentFailed(let reason):
      "The photos could not be aligned: \(reason)"
    case .noSurface(let reason):
      "No surface could be made: \(reason)"
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .unreadableFolder:
      "Check the path and its permissions."
    case .noPhotos:
      "Name a folder with JPEG or PNG photos of one object, taken all around it."
    case .tooFewPhotos:
      "Take 20 or more photos all around the object, each overlapping its neighbours by 70 %."
    case .alignmentFailed:
      "Take sharp photos of a textured object that overlap by 70 % or more, "
        + "or try high feature sensitivity."
    case .noSurface:
      "Take more photos from more directions, or turn object masking off."
    }
  }
}

import Foundation

/// The reason why a run can't continue: a sentence and a remedy.
package enum PipelineError: LocalizedError, Equatable, Sendable {
  case unreadableFolder(path: String, reason: String)
  case noPhotos(folder: String, rejected: Int)
  case tooFewPhotos(found: Int, needed: Int)
  case tooFewCameras(found: Int, needed: Int, photos: Int, cameras: Int)
  case camerasDontFit(reason: String)
  case alignmentFailed(reason: String)
  case noSurface(reason: String)
  case emptyCrop

  package var errorDescription: String? {
    switch self {
    case .unreadableFolder(let path, let reason):
      "\(path) can't be read: \(reason)."
    case .noPhotos(let folder, let rejected):
      rejected == 0
        ? "\(folder) holds no photos."
        : "\(folder) holds no usable photo; \(rejected) files were refused."
    case .tooFewPhotos(let found, let needed):
      "Only \(found) usable photos; a reconstruction needs at least \(needed)."
    case .tooFewCameras(let count, let needed, let photos, let cameras):
      "Only \(count) of the \(photos) photos match one of the \(cameras) given cameras; "
        + "\(needed) are needed."
    case .camerasDontFit(let reason):
      "The cameras don't fit the photos: \(reason)"
    case .alignmentFailed(let reason):
      "The photos could not be aligned: \(reason)"
    case .noSurface(let reason):
      "No surface could be made: \(reason)"
    case .emptyCrop:
      "No part of the surface is inside the given bounds."
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .unreadableFolder:
      "Check the path and its permissions."
    case .noPhotos:
      "Name a folder with photos (JPEG, HEIC or PNG) of one object, taken all around it."
    case .tooFewPhotos:
      "Take 20 or more photos all around the object, each overlapping its neighbors by 70 %."
    case .tooFewCameras:
      "Cameras are matched to photos by file name, and must be for the whole photo in its upright "
        + "orientation; specify the folder of the photos that they were estimated from."
    case .camerasDontFit:
      "Check that they are the cameras of these photos, with poses from the world to the camera (x "
        + "right, y down, z forward), consistent angles and units, and focal lengths in pixels."
    case .alignmentFailed:
      "Take sharp photos of a textured object that overlap by 70 % or more, "
        + "or try high feature sensitivity."
    case .noSurface:
      "Take more photos from more directions, or turn object masking off."
    case .emptyCrop:
      "Specify bounds in the model's frame, like the bounds of the whole model."
    }
  }
}

extension PipelineError {
  /// The minimum number of photos. Limit: two have a relative pose, but give no usable surface.
  package static let minimumPhotos = 3

  /// Throws `tooFewPhotos` for fewer than `needed`.
  package static func checkCount(_ count: Int, needed: Int = minimumPhotos) throws {
    guard count >= needed else { throw PipelineError.tooFewPhotos(found: count, needed: needed) }
  }
}

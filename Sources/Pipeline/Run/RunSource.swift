import Foundation
import SceneModel

/// The input of a run.
package enum RunSource: Sendable {
  /// A folder of photos, which are aligned. `readings` are by sample ID, and take precedence over
  /// those in files next to the photos.
  case photos(in: URL, readings: [Int: SensorReading] = [:])
  /// A folder of photos with cameras, poses and optionally points, which are used unchanged.
  case photosWithCameras(in: URL, KnownCameras)
  /// The cameras and the surface of a finished run: stages before the model are not repeated.
  case savedRun(SavedRun)

  /// The folder of the photos.
  package var photoFolder: URL {
    switch self {
    case .photos(let folder, _), .photosWithCameras(let folder, _): folder
    case .savedRun(let saved): saved.photoFolder
    }
  }

  /// Whether cameras and surface are determined from the photos alone.
  var isPhotosOnly: Bool {
    if case .photos = self { true } else { false }
  }
}

import Foundation
import SceneModel

/// What a run begins with.
package enum RunSource: Sendable {
  /// A folder of photos, which are aligned. `readings` are by sample id, and come before those in
  /// files next to the photos.
  case photos(in: URL, readings: [Int: SensorReading] = [:])
  /// A folder of photos with cameras, poses and maybe points, which are used unmoved.
  case photosWithCameras(in: URL, KnownCameras)
  /// The cameras and the surface of a finished run: nothing before the model is made again.
  case savedRun(SavedRun)

  /// The folder of the photos.
  package var photoFolder: URL {
    switch self {
    case .photos(let folder, _), .photosWithCameras(let folder, _): folder
    case .savedRun(let saved): saved.photoFolder
    }
  }

  /// Whether cameras and surface are found from the photos alone.
  var isPhotosOnly: Bool {
    if case .photos = self { true } else { false }
  }
}

/// The result of alignment: cameras, poses and sparse points in one right-handed world frame.
package struct Reconstruction: Sendable {
  package var cameras: [Camera]
  package var photos: [Photo]
  /// `cameraFromWorld` by photo ID; nil if the photo is not registered.
  package var poses: [RigidTransform?]
  package var points: [ScenePoint]
  package var worldFrame: WorldFrame
  /// Photos that passed validation but could not be registered, with the reasons.
  package var unregistered: [RejectedPhoto]

  package init(
    cameras: [Camera], photos: [Photo], poses: [RigidTransform?], points: [ScenePoint],
    worldFrame: WorldFrame = WorldFrame(), unregistered: [RejectedPhoto] = []
  ) {
    self.cameras = cameras
    self.photos = photos
    self.poses = poses
    self.points = points
    self.worldFrame = worldFrame
    self.unregistered = unregistered
  }

  /// The registered photos in ascending order.
  package var registered: [ID<Photo>] { photos.map(\.id).filter { poses[$0.index] != nil } }

  /// The camera of a photo.
  package func camera(of photo: ID<Photo>) -> Camera { cameras[photos[photo.index].camera.index] }

  /// The mean reprojection error over all observations in pixels; 0 without observations.
  package var meanReprojectionError: Double {
    var (sum, count) = (0.0, 0)
    for point in points {
      for observation in point.track {
        guard let pose = poses[observation.photo.index] else { continue }
        let projected = camera(of: observation.photo).project(pose * point.position)
        sum += (projected - observation.pixel).length
        count += 1
      }
    }
    return count > 0 ? sum / Double(count) : 0
  }
}

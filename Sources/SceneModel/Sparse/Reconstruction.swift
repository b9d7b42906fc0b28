/// The keypoint of a point in one photo.
package struct Observation: Hashable, Codable, Sendable {
  package var photo: ID<Photo>
  /// Index into the photo's `FeatureSet`; negative without a feature.
  package var feature: Int32
  /// The keypoint in pixels of the upright photo, origin at the top-left corner.
  package var pixel: SIMD2<Double>

  package init(photo: ID<Photo>, feature: Int32, pixel: SIMD2<Double>) {
    self.photo = photo
    self.feature = feature
    self.pixel = pixel
  }
}

/// A triangulated point and its observations.
package struct ScenePoint: Hashable, Codable, Sendable {
  /// In the world frame.
  package var position: SIMD3<Double>
  /// RGB.
  package var color: SIMD3<UInt8>
  /// Mean reprojection error in pixels.
  package var error: Double
  /// Sorted by photo; at most one observation per photo.
  package var track: [Observation]

  package init(
    position: SIMD3<Double>, color: SIMD3<UInt8> = .zero, error: Double = 0,
    track: [Observation] = []
  ) {
    self.position = position
    self.color = color
    self.error = error
    self.track = track
  }
}

/// The sources of the scale and the up direction of the world frame.
package struct WorldFrame: Hashable, Codable, Sendable {
  /// The source of the scale.
  package enum Scale: String, Hashable, Codable, Sendable {
    /// Depth maps, GPS, distances measured by the user, or none of them.
    case depth, gps, knownDistance, arbitrary
    /// The cameras were given, and their unit was declared to be the meter.
    case given

    /// Whether lengths are in meters.
    package var isMetric: Bool { self != .arbitrary }
  }
  /// The source of the up direction.
  package enum Up: String, Hashable, Codable, Sendable {
    case gravity, gps, supportPlane, cameras, unknown
    /// The user named the side of the photos that was up.
    case chosen
    /// An object that was moved: that of its largest group of photos without a move.
    case placement
  }

  package var scale: Scale
  package var up: Up
  /// The direction opposite to gravity when the photos were taken, if the user had the object
  /// turned so that it isn't +y.
  package var turnedVertical: SIMD3<Double>?
  /// The direction opposite to gravity when the photos were taken.
  package var vertical: SIMD3<Double> { turnedVertical ?? [0, 1, 0] }

  package init(scale: Scale = .arbitrary, up: Up = .unknown) {
    self.scale = scale
    self.up = up
  }
}

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

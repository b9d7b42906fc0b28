import CKernels
import SceneModel

/// Cameras and photo poses in the form that the alignment kernels require.
package struct PosedPhotos: Sendable {
  package var cameras: [Camera]
  /// `cameraFromWorld` by photo; observations must not refer to photos without one.
  package var poses: [RigidTransform?]
  /// The camera index of each photo.
  package var cameraOfPhoto: [Int32]

  package init(cameras: [Camera], poses: [RigidTransform?], cameraOfPhoto: [Int32]) {
    precondition(poses.count == cameraOfPhoto.count)
    self.cameras = cameras
    self.poses = poses
    self.cameraOfPhoto = cameraOfPhoto
  }

  /// Calls `body` with the C representation, valid only during the call.
  func withViews(_ body: (UnsafePointer<ck_views>) -> ck_status) -> ck_status {
    let models = cameras.map(ck_camera_model.init)
    let rawPoses = poses.map { ck_pose($0 ?? .identity) }
    return models.withUnsafeBufferPointer { models in
      rawPoses.withUnsafeBufferPointer { rawPoses in
        cameraOfPhoto.withUnsafeBufferPointer { cameraOfPhoto in
          var views = ck_views(
            cameras: models.baseAddress, camera_count: models.count, poses: rawPoses.baseAddress,
            photo_cameras: cameraOfPhoto.baseAddress, photo_count: rawPoses.count)
          return body(&views)
        }
      }
    }
  }
}

/// An observation of a point in a photo.
package struct PointObservation: Hashable, Sendable {
  /// Index of the photo.
  package var photo: Int32
  /// Index of the point, or of the track.
  package var point: Int32
  /// Pixels of the upright photo, origin at the top-left corner.
  package var pixel: SIMD2<Double>

  package init(photo: Int32, point: Int32, pixel: SIMD2<Double>) {
    self.photo = photo
    self.point = point
    self.pixel = pixel
  }

  var raw: ck_observation {
    ck_observation(photo: photo, point: point, x: pixel.x, y: pixel.y)
  }
}

extension ck_camera_model {
  init(_ camera: Camera) {
    self.init(
      fx: camera.focalLength.x, fy: camera.focalLength.y, cx: camera.principalPoint.x,
      cy: camera.principalPoint.y, k1: camera.distortion.x, k2: camera.distortion.y,
      p1: camera.distortion.z, p2: camera.distortion.w)
  }
}

extension ck_pose {
  init(_ pose: RigidTransform) {
    let (q, t) = (pose.rotation, pose.translation)
    self.init(qx: q.x, qy: q.y, qz: q.z, qw: q.w, tx: t.x, ty: t.y, tz: t.z)
  }
}

extension RigidTransform {
  init(_ pose: ck_pose) {
    self.init(
      rotation: Quaternion(x: pose.qx, y: pose.qy, z: pose.qz, w: pose.qw),
      translation: [pose.tx, pose.ty, pose.tz])
  }
}

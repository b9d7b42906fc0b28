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
  func withKernelValue<Result>(
    _ body: (UnsafePointer<ck_posed_photos>) throws -> Result
  ) rethrows -> Result {
    let cameras = KernelArray(cameras.lazy.map(ck_camera.init))
    let poses = KernelArray(poses.lazy.map { ck_pose($0 ?? .identity) })
    return try withExtendedLifetime((cameras, poses)) {
      try cameraOfPhoto.withUnsafeBufferPointer { cameraOfPhoto in
        var photos = ck_posed_photos(
          cameras: cameras.base, camera_count: cameras.count, poses: poses.base,
          photo_cameras: cameraOfPhoto.baseAddress, photo_count: poses.count)
        return try body(&photos)
      }
    }
  }
}

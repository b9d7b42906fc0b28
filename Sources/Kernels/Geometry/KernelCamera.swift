import CKernels
import SceneModel

extension ck_camera {
  init(_ camera: Camera) {
    self.init(
      fx: camera.focalLength.x, fy: camera.focalLength.y, cx: camera.principalPoint.x,
      cy: camera.principalPoint.y, k1: camera.distortion.x, k2: camera.distortion.y,
      p1: camera.distortion.z, p2: camera.distortion.w, width: Int32(camera.width),
      height: Int32(camera.height))
  }

  /// The camera with an image size of `width` × `height`, and otherwise unchanged parameters.
  init(_ camera: Camera, width: Int, height: Int) {
    self.init(camera)
    (self.width, self.height) = (Int32(width), Int32(height))
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

extension ck_view {
  init(_ view: PinholeView) {
    self.init(
      camera: ck_camera(view.camera, width: view.image.width, height: view.image.height),
      camera_from_world: ck_pose(view.cameraFromWorld))
  }
}

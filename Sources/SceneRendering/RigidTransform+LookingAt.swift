import SceneModel

extension RigidTransform {
  /// `cameraFromWorld` of an upright camera at `center` whose optical axis passes through `target`.
  package static func lookingAt(
    _ target: SIMD3<Double>, from center: SIMD3<Double>
  ) -> RigidTransform {
    let forward = (target - center).normalized
    let right = forward.cross([0, 1, 0]).normalized
    let rotation = Quaternion(Matrix3(rows: right, forward.cross(right), forward))
    return RigidTransform(rotation: rotation, translation: -(rotation * center))
  }
}

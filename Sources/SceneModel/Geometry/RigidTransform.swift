/// A rotation followed by a translation. Values are named `bFromA`, so that compositions are
/// self-explanatory.
///
/// `x_b = rotation · x_a + translation`.
package struct RigidTransform: Hashable, Codable, Sendable {
  package var rotation: Quaternion
  package var translation: SIMD3<Double>

  package init(rotation: Quaternion, translation: SIMD3<Double>) {
    self.rotation = rotation
    self.translation = translation
  }

  package static let identity = RigidTransform(rotation: .identity, translation: .zero)

  /// `aFromB` of a transform `bFromA`.
  package var inverse: RigidTransform {
    let r = rotation.conjugate
    return RigidTransform(rotation: r, translation: -(r * translation))
  }

  /// The origin of frame b in frame a; for a `cameraFromWorld`, the camera center in the world.
  package var center: SIMD3<Double> { -(rotation.conjugate * translation) }

  /// Maps a point from frame a to frame b.
  package static func * (bFromA: RigidTransform, point: SIMD3<Double>) -> SIMD3<Double> {
    bFromA.rotation * point + bFromA.translation
  }

  /// The composition `cFromA`.
  package static func * (cFromB: RigidTransform, bFromA: RigidTransform) -> RigidTransform {
    RigidTransform(
      rotation: (cFromB.rotation * bFromA.rotation).normalized,
      translation: cFromB.rotation * bFromA.translation + cFromB.translation)
  }
}

/// A uniform scale, a rotation and a translation: `x_b = scale · rotation · x_a + translation`.
package struct SimilarityTransform: Hashable, Codable, Sendable {
  package var scale: Double
  package var rotation: Quaternion
  package var translation: SIMD3<Double>

  package init(scale: Double, rotation: Quaternion, translation: SIMD3<Double>) {
    self.scale = scale
    self.rotation = rotation
    self.translation = translation
  }

  package static let identity = SimilarityTransform(
    scale: 1, rotation: .identity, translation: .zero)

  /// `aFromB` of a transform `bFromA`.
  package var inverse: SimilarityTransform {
    let r = rotation.conjugate
    return SimilarityTransform(
      scale: 1 / scale, rotation: r, translation: -(r * translation) / scale)
  }

  /// Maps a point from frame a to frame b.
  package static func * (bFromA: SimilarityTransform, point: SIMD3<Double>) -> SIMD3<Double> {
    bFromA.scale * (bFromA.rotation * point) + bFromA.translation
  }

  /// Transforms a camera pose from frame a to frame b: the resulting `cameraFromB` shows the same
  /// view, with distances multiplied by `scale`.
  package func applied(toCameraFromA cameraFromA: RigidTransform) -> RigidTransform {
    let rotation = (cameraFromA.rotation * self.rotation.conjugate).normalized
    return RigidTransform(
      rotation: rotation,
      translation: scale * cameraFromA.translation - rotation * translation)
  }
}

/// A linear map, possibly with a reflection, followed by a translation.
package struct AffineMap: Hashable, Sendable {
  /// The images of the axes.
  package var x: SIMD3<Float>
  package var y: SIMD3<Float>
  package var z: SIMD3<Float>
  package var translation: SIMD3<Float>

  package init(
    x: SIMD3<Float>, y: SIMD3<Float>, z: SIMD3<Float>, translation: SIMD3<Float> = .zero
  ) {
    (self.x, self.y, self.z) = (x, y, z)
    self.translation = translation
  }

  package static let identity = AffineMap(x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1])

  /// Whether the map contains a reflection (negative determinant).
  package var mirrors: Bool { x.dot(y.cross(z)) < 0 }

  /// Maps a point.
  package static func * (bFromA: AffineMap, point: SIMD3<Float>) -> SIMD3<Float> {
    bFromA.x * point.x + bFromA.y * point.y + bFromA.z * point.z + bFromA.translation
  }

  /// Maps a unit surface normal.
  package func normal(_ normal: SIMD3<Float>) -> SIMD3<Float> {
    // The inverse transpose up to scale.
    let image = y.cross(z) * normal.x + z.cross(x) * normal.y + x.cross(y) * normal.z
    return (mirrors ? -image : image).normalized
  }
}

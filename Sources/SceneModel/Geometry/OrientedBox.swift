/// An oriented box, given in the world frame.
package struct OrientedBox: Hashable, Codable, Sendable {
  package var center: SIMD3<Float>
  /// Half the edge lengths.
  package var halfExtents: SIMD3<Float>
  /// The rotation of `worldFromBox`.
  package var rotation: Quaternion

  package init(
    center: SIMD3<Float>, halfExtents: SIMD3<Float>, rotation: Quaternion = .identity
  ) {
    self.center = center
    self.halfExtents = halfExtents
    self.rotation = rotation
  }

  /// An axis-aligned box from its minimum and maximum corners.
  package init(min: SIMD3<Float>, max: SIMD3<Float>) {
    self.init(center: (min + max) / 2, halfExtents: (max - min) / 2)
  }

  /// The unit directions of the edges in the world frame.
  package var axes: [SIMD3<Float>] {
    [SIMD3(1, 0, 0), SIMD3(0, 1, 0), SIMD3(0, 0, 1)].map { SIMD3<Float>(rotation * $0) }
  }

  /// The box extended by `margin` on all sides.
  package func grown(by margin: Float) -> OrientedBox {
    OrientedBox(center: center, halfExtents: halfExtents + margin, rotation: rotation)
  }
}

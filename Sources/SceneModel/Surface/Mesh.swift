/// A triangle mesh in the world frame.
package struct Mesh: Sendable {
  package var positions: [SIMD3<Float>]
  /// Unit vertex normals, one per position, or empty.
  package var normals: [SIMD3<Float>]
  /// RGB vertex colors, one per position, or empty.
  package var colors: [SIMD3<UInt8>]
  package var triangles: [Triangle]

  package init(
    positions: [SIMD3<Float>] = [], normals: [SIMD3<Float>] = [], colors: [SIMD3<UInt8>] = [],
    triangles: [Triangle] = []
  ) {
    self.positions = positions
    self.normals = normals
    self.colors = colors
    self.triangles = triangles
  }

  /// The axis-aligned bounding box; nil for an empty mesh.
  package var bounds: (min: SIMD3<Float>, max: SIMD3<Float>)? {
    guard let first = positions.first else { return nil }
    return positions.reduce((first, first)) {
      (pointwiseMin($0.0, $1), pointwiseMax($0.1, $1))
    }
  }
}

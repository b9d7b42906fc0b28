/// Three vertex indices, counterclockwise when viewed from outside; 12 bytes.
package struct Triangle: Hashable, Sendable, BitwiseCopyable {
  package var a: UInt32
  package var b: UInt32
  package var c: UInt32

  package init(_ a: UInt32, _ b: UInt32, _ c: UInt32) {
    (self.a, self.b, self.c) = (a, b, c)
  }

  /// The corners of the quad formed by (a, b, c) and `other` = (a, c, d).
  package func quad(with other: Triangle) -> [UInt32] { [a, b, c, other.c] }

  /// The triangle with reversed winding.
  package var flipped: Triangle { Triangle(a, c, b) }
}

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

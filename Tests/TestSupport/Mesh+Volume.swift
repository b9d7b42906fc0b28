import SceneModel

extension Mesh {
  /// The volume that a closed mesh encloses; negative if its triangles face inward.
  package var volume: Double {
    triangles.reduce(0) { sum, triangle in
      let (a, b, c) = (
        SIMD3<Double>(positions[Int(triangle.a)]), SIMD3<Double>(positions[Int(triangle.b)]),
        SIMD3<Double>(positions[Int(triangle.c)])
      )
      return sum + a.dot(b.cross(c)) / 6
    }
  }
}

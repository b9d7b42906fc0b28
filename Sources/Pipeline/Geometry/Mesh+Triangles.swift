import SceneModel

/// Corners, centers and areas of triangles.
extension Mesh {
  /// The three positions of a triangle.
  func corners(of triangle: Triangle) -> (SIMD3<Float>, SIMD3<Float>, SIMD3<Float>) {
    (positions[Int(triangle.a)], positions[Int(triangle.b)], positions[Int(triangle.c)])
  }

  /// The centroid of a triangle.
  func center(of triangle: Triangle) -> SIMD3<Float> {
    let (a, b, c) = corners(of: triangle)
    return (a + b + c) / 3
  }

  /// The normal of a triangle, as long as twice its area.
  func scaledNormal(of triangle: Triangle) -> SIMD3<Float> {
    let (a, b, c) = corners(of: triangle)
    return (b - a).cross(c - a)
  }

  /// Area of each triangle.
  func triangleAreas() -> [Float] {
    triangles.map { scaledNormal(of: $0).length / 2 }
  }

  /// The mesh with only the vertices that triangles reference, in their order.
  func withoutUnusedVertices() -> Mesh {
    var isUsed = [Bool](repeating: false, count: positions.count)
    for triangle in triangles { for vertex in triangle.vertices { isUsed[vertex] = true } }
    let kept = positions.indices.filter { isUsed[$0] }
    var numbers = [UInt32](repeating: 0, count: positions.count)
    for (number, vertex) in kept.enumerated() { numbers[vertex] = UInt32(number) }
    return Mesh(
      positions: kept.map { positions[$0] },
      normals: normals.isEmpty ? [] : kept.map { normals[$0] },
      colors: colors.isEmpty ? [] : kept.map { colors[$0] },
      triangles: triangles.map {
        Triangle(numbers[Int($0.a)], numbers[Int($0.b)], numbers[Int($0.c)])
      })
  }
}

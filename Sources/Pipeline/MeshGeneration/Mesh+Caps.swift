import SceneModel

extension Mesh {
  /// Caps: a triangle fan over each open boundary of the removed faces. The fans' center vertices
  /// are numbered after the mesh's own vertices.
  func caps(isRemoved: [Bool]) -> (centers: [SIMD3<Float>], triangles: [Triangle]) {
    let edges = DirectedEdges(of: self)
    var next: [UInt32: UInt32] = [:]
    for (triangle, isRemoved) in zip(triangles, isRemoved) where isRemoved {
      for edge in triangle.edges where edges.isOpen(edge) { next[edge.x] = edge.y }
    }
    var result: (centers: [SIMD3<Float>], triangles: [Triangle]) = ([], [])
    for start in next.keys.sorted() {
      var border: [UInt32] = []
      var vertex = start
      while let following = next.removeValue(forKey: vertex) {
        border.append(vertex)
        vertex = following
      }
      guard vertex == start, border.count > 2 else { continue }
      let center = UInt32(positions.count + result.centers.count)
      let sum = border.reduce(SIMD3<Float>.zero) { $0 + positions[Int($1)] }
      result.centers.append(sum / Float(border.count))
      result.triangles += zip(border, border.dropFirst() + [start]).map { Triangle($1, $0, center) }
    }
    return result
  }

  /// The mesh with the caps added.
  func adding(_ caps: (centers: [SIMD3<Float>], triangles: [Triangle])) -> Mesh {
    var mesh = self
    mesh.positions += caps.centers
    mesh.triangles += caps.triangles
    return mesh
  }
}

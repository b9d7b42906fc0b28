import SceneModel

extension [Triangle] {
  /// Which vertices are so many edges of the triangles, or fewer, from those in a set; both have a
  /// value for each vertex.
  func vertices(within edges: Int, of set: [Bool]) -> [Bool] {
    var isNear = set
    for _ in 0..<edges {
      let reached = filter { $0.vertices.contains { isNear[$0] } }
      for triangle in reached { for vertex in triangle.vertices { isNear[vertex] = true } }
    }
    return isNear
  }
}

import SceneModel

extension [Triangle] {
  /// The vertices within `edges` edges of the vertices in `set`; both arrays have a value per
  /// vertex.
  func vertices(within edges: Int, of set: [Bool]) -> [Bool] {
    var isNear = set
    for _ in 0..<edges {
      let reached = filter { $0.vertices.contains { isNear[$0] } }
      for triangle in reached { for vertex in triangle.vertices { isNear[vertex] = true } }
    }
    return isNear
  }
}

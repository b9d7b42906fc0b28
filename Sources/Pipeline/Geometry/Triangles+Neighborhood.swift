import SceneModel

extension [Triangle] {
  /// The vertices within `edges` edges of the vertices in `set`; both arrays have a value per
  /// vertex.
  func vertices(within edges: Int, of set: [Bool]) -> [Bool] {
    var isNear = set
    for _ in 0..<edges {
      var reached: [Int] = []
      for triangle in self {
        let (a, b, c) = (Int(triangle.a), Int(triangle.b), Int(triangle.c))
        guard isNear[a] || isNear[b] || isNear[c], !(isNear[a] && isNear[b] && isNear[c])
        else { continue }
        reached += [a, b, c]
      }
      for vertex in reached { isNear[vertex] = true }
    }
    return isNear
  }
}

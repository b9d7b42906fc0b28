import SceneModel

/// Triangles grouped into patches that share vertices.
struct MeshComponents: Sendable {
  /// Every triangle's component, numbered by their first triangle.
  let components: [Int32]
  let count: Int

  init(_ triangles: [Triangle], vertexCount: Int) {
    var parents = (0..<Int32(vertexCount)).map { $0 }
    func root(_ vertex: Int32) -> Int32 {
      var v = vertex
      while parents[Int(v)] != v {
        parents[Int(v)] = parents[Int(parents[Int(v)])]
        v = parents[Int(v)]
      }
      return v
    }
    for triangle in triangles {
      let a = root(Int32(triangle.a))
      for other in [triangle.b, triangle.c] {
        let (r, s) = (root(a), root(Int32(other)))
        if r != s { parents[Int(max(r, s))] = min(r, s) }
      }
    }
    var numbers = [Int32](repeating: -1, count: vertexCount)
    var next: Int32 = 0
    components = triangles.map { triangle in
      let r = Int(root(Int32(triangle.a)))
      if numbers[r] < 0 {
        numbers[r] = next
        next += 1
      }
      return numbers[r]
    }
    count = Int(next)
  }
}

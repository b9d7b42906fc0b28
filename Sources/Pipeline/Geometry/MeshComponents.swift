import SceneModel

/// Triangles grouped into components that share vertices.
struct MeshComponents: Sendable {
  /// Every triangle's component, numbered in order of their first triangle.
  let components: [Int32]
  let count: Int

  init(_ triangles: [Triangle], vertexCount: Int) {
    var sets = DisjointSets(count: vertexCount)
    for triangle in triangles {
      sets.join(Int(triangle.a), Int(triangle.b))
      sets.join(Int(triangle.a), Int(triangle.c))
    }
    var numbers = [Int32](repeating: -1, count: vertexCount)
    var next: Int32 = 0
    components = triangles.map { triangle in
      let r = sets.root(Int(triangle.a))
      if numbers[r] < 0 {
        numbers[r] = next
        next += 1
      }
      return numbers[r]
    }
    count = Int(next)
  }
}

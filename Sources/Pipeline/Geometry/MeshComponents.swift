import SceneModel

/// Triangles grouped into components that share vertices, or edges.
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
    self.init(triangles.map { sets.root(Int($0.a)) }, rootCount: vertexCount)
  }

  init(sharingEdges triangles: [Triangle]) {
    var edges: [(key: UInt64, triangle: Int)] = []
    edges.reserveCapacity(3 * triangles.count)
    for (index, triangle) in triangles.enumerated() {
      for edge in triangle.edges {
        edges.append((UInt64(min(edge.x, edge.y)) << 32 | UInt64(max(edge.x, edge.y)), index))
      }
    }
    edges.sort { ($0.key, $0.triangle) < ($1.key, $1.triangle) }
    var sets = DisjointSets(count: triangles.count)
    for (edge, next) in zip(edges, edges.dropFirst()) where edge.key == next.key {
      sets.join(edge.triangle, next.triangle)
    }
    self.init(triangles.indices.map { sets.root($0) }, rootCount: triangles.count)
  }

  /// Numbers the roots of the triangles' sets.
  private init(_ roots: [Int], rootCount: Int) {
    var numbers = [Int32](repeating: -1, count: rootCount)
    var next: Int32 = 0
    components = roots.map { root in
      if numbers[root] < 0 {
        numbers[root] = next
        next += 1
      }
      return numbers[root]
    }
    count = Int(next)
  }
}

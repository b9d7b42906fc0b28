import SceneModel

/// The directed edges of a mesh's triangles.
struct DirectedEdges: Sendable {
  private var targets: VertexLists<UInt32>

  init(of mesh: Mesh) {
    var counts = [Int32](repeating: 0, count: mesh.positions.count)
    for triangle in mesh.triangles { for vertex in triangle.vertices { counts[vertex] += 1 } }
    targets = VertexLists(capacities: counts, empty: 0)
    for triangle in mesh.triangles {
      targets.append(triangle.b, at: triangle.a)
      targets.append(triangle.c, at: triangle.b)
      targets.append(triangle.a, at: triangle.c)
    }
  }

  /// Whether an edge has no triangle on its other side.
  func isOpen(_ edge: SIMD2<UInt32>) -> Bool { !targets.contains(edge.x, at: edge.y) }
}

import SceneModel

/// A short list for each vertex of a mesh, all in one array: sets are slow for millions of edges.
struct VertexLists<Value: Equatable & Sendable>: Sendable {
  private var offsets: [Int32]
  private var ends: [Int32]
  private var values: [Value]

  /// `capacities` bounds the length of each vertex's list.
  init(capacities: [Int32], empty: Value) {
    var sum: Int32 = 0
    offsets = capacities.map { capacity in
      defer { sum += capacity }
      return sum
    }
    ends = offsets
    values = Array(repeating: empty, count: Int(sum))
  }

  /// Appends a value to the list of a vertex, within its capacity.
  mutating func append(_ value: Value, at vertex: UInt32) {
    values[Int(ends[Int(vertex)])] = value
    ends[Int(vertex)] += 1
  }

  subscript(vertex: UInt32) -> ArraySlice<Value> {
    values[Int(offsets[Int(vertex)])..<Int(ends[Int(vertex)])]
  }

  func contains(_ value: Value, at vertex: UInt32) -> Bool { self[vertex].contains(value) }
}

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

import SceneModel

/// A short list for each vertex of a mesh, all in one array: of millions of edges, sets are slow.
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

  mutating func append(_ value: Value, at vertex: UInt32) {
    values[Int(ends[Int(vertex)])] = value
    ends[Int(vertex)] += 1
  }

  func contains(_ value: Value, at vertex: UInt32) -> Bool {
    for index in offsets[Int(vertex)]..<ends[Int(vertex)] where values[Int(index)] == value {
      return true
    }
    return false
  }
}

/// The directed edges of triangles.
struct DirectedEdges: Sendable {
  private var targets: VertexLists<UInt32>

  /// Room for the edges of all `triangles`; none of them is in yet.
  init(roomFor triangles: [Triangle], vertexCount: Int) {
    var counts = [Int32](repeating: 0, count: vertexCount)
    for triangle in triangles {
      counts[Int(triangle.a)] += 1
      counts[Int(triangle.b)] += 1
      counts[Int(triangle.c)] += 1
    }
    targets = VertexLists(capacities: counts, empty: 0)
  }

  /// The edges of all triangles of a mesh.
  init(of mesh: Mesh) {
    self.init(roomFor: mesh.triangles, vertexCount: mesh.positions.count)
    for triangle in mesh.triangles { insert(triangle) }
  }

  mutating func insert(_ triangle: Triangle) {
    targets.append(triangle.b, at: triangle.a)
    targets.append(triangle.c, at: triangle.b)
    targets.append(triangle.a, at: triangle.c)
  }

  func contains(_ from: UInt32, _ to: UInt32) -> Bool { targets.contains(to, at: from) }

  /// Whether any edge of the triangle is there.
  func containsEdge(of triangle: Triangle) -> Bool {
    contains(triangle.a, triangle.b) || contains(triangle.b, triangle.c)
      || contains(triangle.c, triangle.a)
  }

  /// Whether no triangle is on the other side of an edge.
  func isOpen(_ edge: SIMD2<UInt32>) -> Bool { !contains(edge.y, edge.x) }
}

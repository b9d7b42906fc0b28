import SceneModel

/// Vertex-triangle incidence and edge adjacency of a mesh.
struct MeshTopology: Sendable {
  /// Two vertices and the triangles on both sides.
  struct Edge: Hashable, Sendable {
    var low: UInt32
    var high: UInt32
    var first: Int32
    /// −1 at the boundary. Of an edge with more than two triangles only the first two are stored.
    var second: Int32
  }

  /// Triangles incident to vertex i: `incident[offsets[i]..<offsets[i + 1]]`, ascending.
  private(set) var offsets: [Int32]
  private(set) var incident: [Int32]
  /// In ascending order of their vertices.
  private(set) var edges: [Edge] = []

  init(_ mesh: Mesh) {
    offsets = Array(repeating: 0, count: mesh.positions.count + 1)
    for triangle in mesh.triangles {
      for vertex in triangle.vertices { offsets[vertex + 1] += 1 }
    }
    for index in 1..<max(1, offsets.count) { offsets[index] += offsets[index - 1] }
    var next = offsets
    incident = Array(repeating: 0, count: 3 * mesh.triangles.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      for vertex in triangle.vertices {
        incident[Int(next[vertex])] = Int32(face)
        next[vertex] += 1
      }
    }
    collectEdges(of: mesh)
  }

  /// The triangles incident to a vertex, ascending.
  func triangles(around vertex: Int) -> ArraySlice<Int32> {
    incident[Int(offsets[vertex])..<Int(offsets[vertex + 1])]
  }

  private mutating func collectEdges(of mesh: Mesh) {
    // Each vertex collects its edges to higher-numbered vertices.
    var found: [(high: UInt32, face: Int32)] = []
    for low in mesh.positions.indices {
      found.removeAll(keepingCapacity: true)
      for face in triangles(around: low) {
        for vertex in mesh.triangles[Int(face)].vertices where vertex > low {
          found.append((UInt32(vertex), face))
        }
      }
      found.sort { ($0.high, $0.face) < ($1.high, $1.face) }
      var index = 0
      while index < found.count {
        var end = index + 1
        while end < found.count, found[end].high == found[index].high { end += 1 }
        edges.append(
          Edge(
            low: UInt32(low), high: found[index].high, first: found[index].face,
            second: end - index > 1 ? found[index + 1].face : -1))
        index = end
      }
    }
  }
}

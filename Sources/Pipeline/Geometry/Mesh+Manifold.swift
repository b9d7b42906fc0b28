import SceneModel

extension Mesh {
  /// The same faces, with non-manifold vertices and edges split, so that every edge has at most two
  /// faces and every vertex one fan.
  ///
  /// Where several surface layers touch along an edge, its faces are paired; none is lost, so that
  /// a closed surface stays closed (Guéziec et al., "Cutting and Stitching", 2001). Colors and
  /// normals are dropped.
  func splitIntoManifold() -> Mesh {
    // Corners of faces that are connected around a vertex.
    var fans = DisjointSets(count: 3 * triangles.count)
    for edge in PairedEdges(of: self).pairs {
      // Both edges connect the same two vertices, in opposite directions.
      fans.join(edge.first, Mesh.next(edge.second))
      fans.join(Mesh.next(edge.first), edge.second)
    }
    var result = Mesh(positions: positions)
    var owner = [Int](repeating: -1, count: positions.count)
    var copies: [Int: UInt32] = [:]
    result.triangles = triangles.indices.map { face in
      let corners = triangles[face].vertices.enumerated().map { corner, vertex -> UInt32 in
        let fan = fans.root(3 * face + corner)
        if owner[vertex] < 0 { owner[vertex] = fan }
        if owner[vertex] == fan { return UInt32(vertex) }
        if let copy = copies[fan] { return copy }
        let copy = UInt32(result.positions.count)
        result.positions.append(positions[vertex])
        copies[fan] = copy
        return copy
      }
      return Triangle(corners[0], corners[1], corners[2])
    }
    return result
  }

  /// The next corner of the same face.
  fileprivate static func next(_ corner: Int) -> Int { corner % 3 == 2 ? corner - 2 : corner + 1 }
}

/// Pairs of opposite directed edges, each edge in at most one pair. An edge is identified by its
/// starting corner.
private struct PairedEdges {
  private(set) var pairs: [(first: Int, second: Int)] = []

  init(of mesh: Mesh) {
    let corners = mesh.triangles.flatMap { [$0.a, $0.b, $0.c] }
    var counts = [Int32](repeating: 0, count: mesh.positions.count)
    for vertex in corners { counts[Int(vertex)] += 1 }
    var leaving = VertexLists(capacities: counts, empty: Int32(-1))
    for (corner, vertex) in corners.enumerated() { leaving.append(Int32(corner), at: vertex) }
    func target(_ corner: Int) -> UInt32 { corners[Mesh.next(corner)] }
    var isPaired = [Bool](repeating: false, count: corners.count)
    pairs.reserveCapacity(corners.count / 2)
    for corner in corners.indices where !isPaired[corner] {
      let (from, to) = (corners[corner], target(corner))
      guard from != to,
        let other = leaving[to].first(where: { !isPaired[Int($0)] && target(Int($0)) == from })
      else { continue }
      (isPaired[corner], isPaired[Int(other)]) = (true, true)
      pairs.append((corner, Int(other)))
    }
  }
}

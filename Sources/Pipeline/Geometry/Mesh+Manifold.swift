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
    /// The vertex or the copy of it that belongs to the fan of a corner.
    func vertex(_ vertex: UInt32, at corner: Int) -> UInt32 {
      let fan = fans.root(corner)
      if owner[Int(vertex)] < 0 { owner[Int(vertex)] = fan }
      if owner[Int(vertex)] == fan { return vertex }
      if let copy = copies[fan] { return copy }
      let copy = UInt32(result.positions.count)
      result.positions.append(positions[Int(vertex)])
      copies[fan] = copy
      return copy
    }
    result.triangles.reserveCapacity(triangles.count)
    for (face, t) in triangles.enumerated() {
      result.triangles.append(
        Triangle(
          vertex(t.a, at: 3 * face), vertex(t.b, at: 3 * face + 1), vertex(t.c, at: 3 * face + 2)))
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
    let corners = mesh.triangles.flatMap { Triple($0.a, $0.b, $0.c) }
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

/// The edge-adjacent triangles of each triangle.
struct FaceNeighbors: Sendable {
  /// Three per triangle; −1 for none.
  private var faces: [Int32]

  init(_ topology: MeshTopology, faceCount: Int) {
    faces = Array(repeating: -1, count: 3 * faceCount)
    for edge in topology.edges where edge.second >= 0 {
      add(edge.second, to: edge.first)
      add(edge.first, to: edge.second)
    }
  }

  private mutating func add(_ neighbor: Int32, to face: Int32) {
    let start = 3 * Int(face)
    guard let slot = (start..<start + 3).first(where: { faces[$0] < 0 }) else { return }
    faces[slot] = neighbor
  }

  /// Flood fill from `start` over the same view's entries of adjacent triangles that `accepts`.
  func flood(
    from start: [FaceViews.Index], in views: FaceViews, where accepts: (FaceViews.Index) -> Bool
  ) -> [FaceViews.Index] {
    var group = start
    var next = 0
    while next < group.count {
      forEach(adjacentTo: group[next], in: views) { if accepts($0) { group.append($0) } }
      next += 1
    }
    return group
  }

  /// Calls `body` with the same view's entries of the triangles adjacent to that of `entry`.
  func forEach(
    adjacentTo entry: FaceViews.Index, in views: FaceViews, _ body: (FaceViews.Index) -> Void
  ) {
    let (face, view) = (Int(views[entry].face), views[entry].view)
    for slot in 3 * face..<3 * face + 3 where faces[slot] >= 0 {
      if let other = views.index(of: Int(faces[slot]), in: view) { body(other) }
    }
  }
}

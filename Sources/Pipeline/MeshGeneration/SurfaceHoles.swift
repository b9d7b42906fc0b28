import SceneModel

/// The removed faces of a mesh, grouped by the hole that they fill.
struct SurfaceHoles: Sendable {
  let count: Int
  /// Whether kept faces surround a hole completely.
  let isEnclosed: [Bool]
  /// Vertices of kept faces; on a hole's faces these are its boundary vertices.
  let isBoundary: [Bool]
  /// The area of each hole.
  let areas: [Float]
  /// The area of the largest connected kept part adjacent to each hole.
  let adjacentAreas: [Float]
  private let removed: [Int]
  private let members: Members

  init(_ mesh: Mesh, isRemoved: [Bool]) {
    removed = isRemoved.indices.filter { isRemoved[$0] }
    var isKept = [Bool](repeating: false, count: mesh.positions.count)
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) where !isRemoved {
      for vertex in triangle.vertices { isKept[vertex] = true }
    }
    isBoundary = isKept
    // Holes that touch only at a vertex are separate: faces of one hole share edges.
    let components = MeshComponents(sharingEdges: removed.map { mesh.triangles[$0] })
    count = components.count
    members = Members(of: components.components, count: components.count)
    isEnclosed = Self.areEnclosed(mesh, removed, components, isKept)
    let faceAreas = mesh.triangleAreas()
    var areas = [Float](repeating: 0, count: components.count)
    for (face, hole) in zip(removed, components.components) { areas[Int(hole)] += faceAreas[face] }
    self.areas = areas
    adjacentAreas = Self.adjacentAreas(mesh, faceAreas, isRemoved, removed, components)
  }

  /// The area of the largest kept component that each hole touches.
  private static func adjacentAreas(
    _ mesh: Mesh, _ faceAreas: [Float], _ isRemoved: [Bool], _ removed: [Int],
    _ holes: MeshComponents
  ) -> [Float] {
    let kept = mesh.triangles.indices.filter { !isRemoved[$0] }
    let parts = MeshComponents(
      kept.map { mesh.triangles[$0] }, vertexCount: mesh.positions.count)
    var areas = [Float](repeating: 0, count: parts.count)
    var partOfVertex = [Int32](repeating: -1, count: mesh.positions.count)
    for (face, part) in zip(kept, parts.components) {
      areas[Int(part)] += faceAreas[face]
      for vertex in mesh.triangles[face].vertices { partOfVertex[vertex] = part }
    }
    var result = [Float](repeating: 0, count: holes.count)
    for (face, hole) in zip(removed, holes.components) {
      for vertex in mesh.triangles[face].vertices where partOfVertex[vertex] >= 0 {
        result[Int(hole)] = max(result[Int(hole)], areas[Int(partOfVertex[vertex])])
      }
    }
    return result
  }

  /// The mesh's face indices in a hole.
  func faces(of hole: Int) -> [Int] { members[hole].map { removed[Int($0)] } }

  /// A hole is enclosed if it has a boundary and all of its edges have faces on both sides.
  private static func areEnclosed(
    _ mesh: Mesh, _ removed: [Int], _ components: MeshComponents, _ isKept: [Bool]
  ) -> [Bool] {
    let edges = DirectedEdges(of: mesh)
    var hasBoundary = [Bool](repeating: false, count: components.count)
    var isOpen = hasBoundary
    for (face, hole) in zip(removed, components.components) {
      let triangle = mesh.triangles[face]
      if triangle.vertices.contains(where: { isKept[$0] }) { hasBoundary[Int(hole)] = true }
      if triangle.edges.contains(where: edges.isOpen) { isOpen[Int(hole)] = true }
    }
    return zip(hasBoundary, isOpen).map { $0 && !$1 }
  }
}

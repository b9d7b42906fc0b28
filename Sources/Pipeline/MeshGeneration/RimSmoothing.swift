import SceneModel

/// Draws a smooth line between what is kept of a surface and what is removed.
///
/// Where photos see less and less of a surface its samples end raggedly, and so does what they
/// support. The share of kept surface around each vertex is found by diffusion, and the line drawn
/// where it is a half: notches are filled with the surface as it was solved, teeth cut off.
struct RimSmoothing: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Steps of diffusion: the line is smooth over about their square root in edges.
    var steps = 80
    /// What is more edges away from the line plays no part.
    var reach = 14

    init() {}
  }

  var options = Options()

  /// Which faces are removed with the smooth line; `canKeep` says which of those so far removed may
  /// come back.
  func run(_ mesh: Mesh, isRemoved: [Bool], canKeep: (Int) -> Bool) -> [Bool] {
    guard isRemoved.contains(true), isRemoved.contains(false) else { return isRemoved }
    let kept = KeptShares(mesh, isRemoved)
    let band = band(mesh, kept)
    guard !band.isEmpty else { return isRemoved }
    let share = diffuse(kept, mesh, band)
    var result = isRemoved
    for face in band {
      let vertices = mesh.triangles[face].vertices
      let isInside = vertices.reduce(0) { $0 + share[$1] } > 1.5
      result[face] = isRemoved[face] ? !(isInside && canKeep(face)) : !isInside
    }
    return result
  }

  /// The faces around the line.
  private func band(_ mesh: Mesh, _ kept: KeptShares) -> [Int] {
    var isNear = kept.shares.map { $0 > 0 && $0 < 1 }
    for _ in 0..<options.reach {
      var isNext = isNear
      for triangle in mesh.triangles where triangle.vertices.contains(where: { isNear[$0] }) {
        for vertex in triangle.vertices { isNext[vertex] = true }
      }
      isNear = isNext
    }
    return mesh.triangles.indices.filter { face in
      mesh.triangles[face].vertices.contains { isNear[$0] }
    }
  }

  /// Draws each vertex towards its neighbours, again and again, the less the longer the edge between:
  /// where there are no samples triangles are large. Vertices at the outer border of the band see a
  /// part of their neighbours only, which are like them.
  private func diffuse(_ kept: KeptShares, _ mesh: Mesh, _ band: [Int]) -> [Float] {
    let edges = edges(mesh, band)
    var counts = [Float](repeating: 0, count: kept.shares.count)
    for edge in edges { for vertex in [edge.a, edge.b] { counts[vertex] += 1 } }
    let vertices = counts.indices.filter { counts[$0] > 0 }
    var share = kept.shares
    var flows = [Float](repeating: 0, count: share.count)
    for _ in 0..<options.steps {
      for edge in edges {
        let flow = edge.weight * (share[edge.b] - share[edge.a])
        flows[edge.a] += flow
        flows[edge.b] -= flow
      }
      for vertex in vertices {
        share[vertex] += flows[vertex] / (2 * counts[vertex])
        flows[vertex] = 0
      }
    }
    return share
  }

  private struct Edge {
    var a: Int
    var b: Int
    /// 1 up to the usual length, less by its square beyond.
    var weight: Float
  }

  /// The edges of some faces, those between two of them twice.
  private func edges(_ mesh: Mesh, _ faces: [Int]) -> [Edge] {
    let edges = faces.flatMap { mesh.triangles[$0].edges }
    let lengths = edges.map {
      (mesh.positions[Int($0.x)] - mesh.positions[Int($0.y)]).squaredLength
    }
    let usual = lengths.sorted()[lengths.count / 2]
    return zip(edges, lengths).map { edge, length in
      Edge(
        a: Int(edge.x), b: Int(edge.y),
        weight: length > usual && length > 0 ? usual / length : 1)
    }
  }
}

/// The share of each vertex's faces that are kept; 0 where it has none.
private struct KeptShares {
  var shares: [Float]

  init(_ mesh: Mesh, _ isRemoved: [Bool]) {
    var kept = [Float](repeating: 0, count: mesh.positions.count)
    var all = kept
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) {
      for vertex in triangle.vertices {
        all[vertex] += 1
        if !isRemoved { kept[vertex] += 1 }
      }
    }
    shares = zip(kept, all).map { $1 > 0 ? $0 / $1 : 0 }
  }
}

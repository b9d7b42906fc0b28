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
    let isNear = mesh.triangles.vertices(
      within: options.reach, of: kept.shares.map { $0 > 0 && $0 < 1 })
    return mesh.triangles.indices.filter { face in
      mesh.triangles[face].vertices.contains { isNear[$0] }
    }
  }

  /// Draws each vertex half-way to the mean over its faces by area, again and again: where there are no
  /// samples faces are large. Vertices at the outer border of the band see a part of their faces only,
  /// which are like the others.
  private func diffuse(_ kept: KeptShares, _ mesh: Mesh, _ band: [Int]) -> [Float] {
    let triangles = band.map { mesh.triangles[$0] }
    let thirds = triangles.map { triangle in
      let (a, b, c) = mesh.corners(of: triangle)
      return (b - a).cross(c - a).length / 3
    }
    var areas = [Float](repeating: 0, count: kept.shares.count)
    for (triangle, third) in zip(triangles, thirds) {
      for vertex in triangle.vertices { areas[vertex] += 3 * third }
    }
    let vertices = areas.indices.filter { areas[$0] > 0 }
    var share = kept.shares
    var sums = [Float](repeating: 0, count: share.count)
    for _ in 0..<options.steps {
      for (triangle, third) in zip(triangles, thirds) {
        let (a, b, c) = (Int(triangle.a), Int(triangle.b), Int(triangle.c))
        let mean = third * (share[a] + share[b] + share[c])
        sums[a] += mean
        sums[b] += mean
        sums[c] += mean
      }
      for vertex in vertices {
        share[vertex] = (share[vertex] + sums[vertex] / areas[vertex]) / 2
        sums[vertex] = 0
      }
    }
    return share
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

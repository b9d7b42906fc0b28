import SceneModel

/// Smooths the boundary between the kept and the removed part of a surface.
///
/// Where photo coverage fades out, samples end raggedly, and so does the surface that they support.
/// Diffusion estimates the share of kept surface around each vertex, and the boundary is drawn at
/// one half: notches are filled with the surface as solved, spikes are cut off.
struct BoundarySmoothing: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Diffusion steps: the boundary is smooth over about √steps edges. Chosen.
    var steps = 80
    /// Only faces within this many edges of the boundary can change. Chosen.
    var reach = 14

    init() {}
  }

  var options = Options()

  /// Which faces are removed after smoothing; `canKeep` decides which of the so far removed faces
  /// may be restored.
  ///
  /// The surface ends where the faces of `isOutside` begin, which stay removed: a boundary there is
  /// not smoothed, and surface that ends just before it is continued.
  func run(
    _ mesh: Mesh, isRemoved: [Bool], isOutside: [Bool]? = nil, canKeep: (Int) -> Bool
  ) -> [Bool] {
    guard isRemoved.contains(true), isRemoved.contains(false) else { return isRemoved }
    let kept = KeptShares(mesh, isRemoved, isOutside)
    let band = band(mesh, kept).filter { isOutside?[$0] != true }
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

  /// The faces near the boundary.
  private func band(_ mesh: Mesh, _ kept: KeptShares) -> [Int] {
    let isNear = mesh.triangles.vertices(
      within: options.reach, of: kept.shares.map { $0 > 0 && $0 < 1 })
    return mesh.triangles.indices.filter { face in
      mesh.triangles[face].vertices.contains { isNear[$0] }
    }
  }

  /// Moves each vertex value halfway to its faces' area-weighted mean, repeatedly; weighted by area
  /// because faces are large where there are no samples. Vertices at the outer border of the band
  /// see only some of their faces, which are similar to the others.
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

/// The share of each vertex's faces that are kept, without the faces outside; 0 for a vertex
/// without faces.
private struct KeptShares {
  var shares: [Float]

  init(_ mesh: Mesh, _ isRemoved: [Bool], _ isOutside: [Bool]?) {
    var kept = [Float](repeating: 0, count: mesh.positions.count)
    var all = kept
    for (index, triangle) in mesh.triangles.enumerated() where isOutside?[index] != true {
      for vertex in triangle.vertices {
        all[vertex] += 1
        if !isRemoved[index] { kept[vertex] += 1 }
      }
    }
    shares = zip(kept, all).map { $1 > 0 ? $0 / $1 : 0 }
  }
}

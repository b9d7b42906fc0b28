import Kernels
import SceneModel

/// Cleans a mesh: keeps large components of non-degenerate faces, makes edges manifold, removes
/// unreferenced vertices, and computes normals and colors.
struct MeshCleaning {
  struct Options: Hashable, Codable, Sendable {
    /// Components with a smaller share of the largest one's area are removed. Chosen.
    var minimumComponentShare = 0.02
    /// An edge shorter than this share of the surface's extent counts as degenerate. Chosen: a few
    /// steps of single precision.
    var coincidenceTolerance: Float = 1e-6
    /// Number of nearest samples that determine a vertex color. Chosen.
    var colorNeighbors = 4
    /// Added to the distance of a sample, in median footprints, before its weight is the inverse of
    /// the sum: a coincident sample must not outweigh all others. Chosen.
    var colorSoftening: Float = 0.2

    init() {}
  }

  var options = Options()

  /// `samples` provide the colors; none are set if it is empty. `part` is given for a part of a
  /// surface. Throws `PipelineError.noSurface` if no face is left.
  func run(
    _ mesh: Mesh, samples: PointCloud, part: SurfacePart? = nil, _ context: StageContext
  ) throws -> Mesh {
    var result = mesh
    result.triangles = joiningCoincidentCorners(mesh, extent: part?.extent)
    result.triangles = nondegenerateTriangles(result)
    try context.control.step(0.2)
    result = result.splitIntoManifold()
    try context.control.step(0.4)
    keepLargeComponents(&result, part)
    result = result.withoutUnusedVertices()
    guard !result.triangles.isEmpty else {
      throw PipelineError.noSurface(reason: "nothing of the surface is supported by the photos.")
    }
    try context.control.step(0.6)
    result.normals = result.areaWeightedNormals()
    if !samples.colors.isEmpty {
      result.colors = try colors(
        result, samples, context.control.part(from: 0.6, to: 1))
    }
    return result
  }

  /// Merges the end points of degenerate edges: marching cubes creates them where the surface
  /// passes through a grid corner. Dropping such faces without merging would leave holes.
  private func joiningCoincidentCorners(_ mesh: Mesh, extent: Float?) -> [Triangle] {
    guard let bounds = mesh.bounds else { return [] }
    let triangles = mesh.triangles.filter { Int(max($0.a, $0.b, $0.c)) < mesh.positions.count }
    let limit = options.coincidenceTolerance * (extent ?? (bounds.max - bounds.min).length)
    var sets = DisjointSets(count: mesh.positions.count)
    for t in triangles {
      let (a, b, c) = mesh.corners(of: t)
      if (b - a).squaredLength <= limit * limit { sets.join(Int(t.a), Int(t.b)) }
      if (c - b).squaredLength <= limit * limit { sets.join(Int(t.b), Int(t.c)) }
      if (a - c).squaredLength <= limit * limit { sets.join(Int(t.c), Int(t.a)) }
    }
    return triangles.map { t in
      Triangle(
        UInt32(sets.root(Int(t.a))), UInt32(sets.root(Int(t.b))),
        UInt32(sets.root(Int(t.c))))
    }
  }

  /// Faces with three distinct corners and nonzero area, without duplicates and without opposite
  /// pairs.
  private func nondegenerateTriangles(_ mesh: Mesh) -> [Triangle] {
    let nondegenerate = mesh.triangles.filter { t in
      guard t.a != t.b, t.b != t.c, t.c != t.a else { return false }
      let (a, b, c) = mesh.corners(of: t)
      return (b - a).cross(c - a).squaredLength > 0
    }.map(\.lowestFirst)
    var counts = [Int32](repeating: 0, count: mesh.positions.count)
    for t in nondegenerate { counts[Int(t.a)] += 1 }
    var faces = VertexLists(capacities: counts, empty: SIMD2<UInt32>())
    for t in nondegenerate where !faces.contains([t.b, t.c], at: t.a) {
      faces.append([t.b, t.c], at: t.a)
    }
    var seen = VertexLists(capacities: counts, empty: SIMD2<UInt32>())
    return nondegenerate.filter { t in
      guard !faces.contains([t.c, t.b], at: t.a), !seen.contains([t.b, t.c], at: t.a)
      else { return false }
      seen.append([t.b, t.c], at: t.a)
      return true
    }
  }

  /// Removes components with a small share of the largest one's area; of a part, complete ones with
  /// a small area.
  private func keepLargeComponents(_ mesh: inout Mesh, _ part: SurfacePart?) {
    let parts = MeshComponents(mesh.triangles, vertexCount: mesh.positions.count)
    var areas = [Double](repeating: 0, count: parts.count)
    for (triangle, part) in zip(mesh.triangles, parts.components) {
      let (a, b, c) = mesh.corners(of: triangle)
      areas[Int(part)] += Double((b - a).cross(c - a).length) / 2
    }
    if let part {
      for (triangle, component) in zip(mesh.triangles, parts.components)
      where part.isAtRim(mesh.positions[Int(triangle.a)]) {
        areas[Int(component)] = .infinity
      }
    }
    let limit = part?.minimumComponentArea ?? options.minimumComponentShare * (areas.max() ?? 0)
    mesh.triangles = zip(mesh.triangles, parts.components)
      .filter { areas[Int($0.1)] >= limit }.map(\.0)
  }

  /// The mean color of the nearest samples, weighted by inverse distance.
  private func colors(
    _ mesh: Mesh, _ samples: PointCloud, _ control: KernelControl
  ) throws -> [SIMD3<UInt8>] {
    let nearest = try NearestPoints(
      of: mesh.positions, in: samples.positions, neighbors: options.colorNeighbors, control)
    let unit = max(samples.medianFootprint ?? 1, .leastNormalMagnitude)
    let softening = options.colorSoftening
    @Sendable func color(_ vertex: Int) -> SIMD3<UInt8> {
      var (sum, weights) = (SIMD3<Float>(), Float(0))
      for k in 0..<nearest.neighbors {
        let slot = vertex * nearest.neighbors + k
        guard nearest.indices[slot] >= 0 else { break }
        let weight = 1 / (nearest.distances[slot] / unit + softening)
        sum += weight * SIMD3<Float>(samples.colors[Int(nearest.indices[slot])])
        weights += weight
      }
      guard weights > 0 else { return .zero }
      return SIMD3<UInt8>((sum / weights).rounded(.toNearestOrAwayFromZero))
    }
    return try control.parallelMap(mesh.positions.count, inUnitsOf: 8192) { $0.map(color) }
  }
}

extension Triangle {
  /// The same triangle, rotated so that its lowest index comes first.
  fileprivate var lowestFirst: Triangle {
    if a < b && a < c { return self }
    return b < c ? Triangle(b, c, a) : Triangle(c, a, b)
  }
}

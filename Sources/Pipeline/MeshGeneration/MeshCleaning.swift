import Kernels
import SceneModel

/// Makes a mesh fit for use: large components of proper faces, edges with two faces at most, no
/// loose vertices, with normals and colours.
struct MeshCleaning {
  struct Options: Hashable, Codable, Sendable {
    /// Components with a smaller share of the largest one's area go.
    var minimumComponentShare = 0.02
    /// Samples that give a vertex its colour.
    var colorNeighbours = 4

    init() {}
  }

  var options = Options()

  /// `samples` give the colours; none are set where it is empty.
  func run(_ mesh: Mesh, samples: PointCloud, _ context: StageContext) throws -> Mesh {
    var result = mesh
    result.triangles = properTriangles(mesh)
    try context.control.step(0.2)
    removeNonManifoldEdges(&result)
    try context.control.step(0.4)
    keepLargeComponents(&result)
    removeLooseVertices(&result)
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

  /// Faces with three different, finite corners and an area, each once.
  private func properTriangles(_ mesh: Mesh) -> [Triangle] {
    let isFinite = mesh.positions.map { $0.x.isFinite && $0.y.isFinite && $0.z.isFinite }
    var seen = Set<Triangle>()
    return mesh.triangles.filter { t in
      guard t.a != t.b, t.b != t.c, t.c != t.a,
        [t.a, t.b, t.c].allSatisfy({ Int($0) < isFinite.count && isFinite[Int($0)] })
      else { return false }
      let (a, b, c) = mesh.corners(of: t)
      guard (b - a).cross(c - a).squaredLength > 0 else { return false }
      let sorted = [t.a, t.b, t.c].sorted()
      return seen.insert(Triangle(sorted[0], sorted[1], sorted[2])).inserted
    }
  }

  /// Drops the later faces where an edge has more than one face a side.
  private func removeNonManifoldEdges(_ mesh: inout Mesh) {
    var edges = Set<UInt64>(minimumCapacity: mesh.triangles.count * 3)
    mesh.triangles = mesh.triangles.filter { t in
      let directed = [(t.a, t.b), (t.b, t.c), (t.c, t.a)].map { UInt64($0) << 32 | UInt64($1) }
      guard directed.allSatisfy({ !edges.contains($0) }) else { return false }
      edges.formUnion(directed)
      return true
    }
  }

  private func keepLargeComponents(_ mesh: inout Mesh) {
    let parts = MeshComponents(mesh.triangles, vertexCount: mesh.positions.count)
    var areas = [Double](repeating: 0, count: parts.count)
    for (triangle, part) in zip(mesh.triangles, parts.components) {
      let (a, b, c) = mesh.corners(of: triangle)
      areas[Int(part)] += Double((b - a).cross(c - a).length) / 2
    }
    let limit = options.minimumComponentShare * (areas.max() ?? 0)
    mesh.triangles = zip(mesh.triangles, parts.components)
      .filter { areas[Int($0.1)] >= limit }.map(\.0)
  }

  private func removeLooseVertices(_ mesh: inout Mesh) {
    var numbers = [UInt32?](repeating: nil, count: mesh.positions.count)
    for t in mesh.triangles { for v in [t.a, t.b, t.c] { numbers[Int(v)] = 0 } }
    var positions: [SIMD3<Float>] = []
    for index in numbers.indices where numbers[index] != nil {
      numbers[index] = UInt32(positions.count)
      positions.append(mesh.positions[index])
    }
    mesh.positions = positions
    mesh.triangles = mesh.triangles.map { t in
      Triangle(numbers[Int(t.a)] ?? 0, numbers[Int(t.b)] ?? 0, numbers[Int(t.c)] ?? 0)
    }
  }

  /// The mean colour of the nearest samples, weighted by inverse distance.
  private func colors(
    _ mesh: Mesh, _ samples: PointCloud, _ control: KernelControl
  ) throws -> [SIMD3<UInt8>] {
    let nearest = try NearestPoints(
      of: mesh.positions, in: samples.positions, neighbours: options.colorNeighbours, control)
    let unit = max(samples.medianFootprint ?? 1, .leastNormalMagnitude)
    return mesh.positions.indices.map { vertex in
      var (sum, weights) = (SIMD3<Float>(), Float(0))
      for k in 0..<nearest.neighbours {
        let slot = vertex * nearest.neighbours + k
        guard nearest.indices[slot] >= 0 else { break }
        let weight = 1 / (nearest.distances[slot] / unit + 0.2)
        sum += weight * SIMD3<Float>(samples.colors[Int(nearest.indices[slot])])
        weights += weight
      }
      guard weights > 0 else { return .zero }
      return SIMD3<UInt8>((sum / weights).rounded(.toNearestOrAwayFromZero))
    }
  }
}

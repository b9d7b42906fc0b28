import Kernels
import SceneModel

/// The triangles' consensus colors, averaged at the vertices.
struct VertexColors: Sendable {
  /// Weight of the mean color, which only determines components without any color. Chosen.
  private static let meanWeight = 1e-6

  private var colors: [SIMD3<Float>?]
  private let topology: MeshTopology

  init(_ rated: RatedViews, _ mesh: Mesh, _ topology: MeshTopology) {
    self.topology = topology
    let areas = mesh.triangleAreas()
    colors = mesh.positions.indices.map { vertex in
      var (sum, weight) = (SIMD3<Float>.zero, Float(0))
      for face in topology.triangles(around: vertex) {
        guard let color = rated.colors[Int(face)] else { continue }
        sum += color * areas[Int(face)]
        weight += areas[Int(face)]
      }
      return weight > 0 ? sum / weight : nil
    }
  }

  /// Interpolates vertices without color harmonically; components without any color get the mean of
  /// all.
  func filled(_ control: KernelControl) throws -> [SIMD3<Float>] {
    let known = colors.compactMap { $0 }
    // Without any color the surface is gray.
    let mean =
      known.isEmpty
      ? SIMD3<Float>(repeating: 128) : known.reduce(.zero, +) / Float(known.count)
    let missing = colors.indices.filter { colors[$0] == nil }
    guard !missing.isEmpty else { return known }
    var unknownOf = [Int](repeating: -1, count: colors.count)
    for (unknown, vertex) in missing.enumerated() { unknownOf[vertex] = unknown }
    var system = SparseLeastSquares(unknownCount: missing.count)
    for unknown in missing.indices {
      system.add(unknown, value: SIMD3<Double>(mean), weight: Self.meanWeight)
    }
    for edge in topology.edges {
      let (low, high) = (Int(edge.low), Int(edge.high))
      switch (colors[low], colors[high]) {
      case (nil, nil): system.add(unknownOf[low], minus: unknownOf[high], weight: 1)
      case (nil, let color?): system.add(unknownOf[low], value: SIMD3(color), weight: 1)
      case (let color?, nil): system.add(unknownOf[high], value: SIMD3(color), weight: 1)
      default: break
      }
    }
    let solution = try system.solve(control)
    return colors.indices.map { colors[$0] ?? SIMD3<Float>(solution[unknownOf[$0]]) }
  }
}

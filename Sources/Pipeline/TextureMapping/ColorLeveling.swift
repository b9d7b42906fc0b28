import Kernels
import SceneModel

/// Global color adjustment at the vertices (Waechter, Moehrle and Goesele, ECCV 2014).
///
/// The unknowns are an offset for every vertex and photo that colors it. Photos that meet at a
/// vertex are made to agree there; a photo's offset varies little along edges; and, beyond the
/// paper, colors are attracted to the mean of all photos, so that no photo's shading spreads over
/// others.
struct ColorLeveling: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Weight of the agreement of two photos at a vertex. Chosen.
    var seam = 4.0
    /// Weight of equal offsets at both ends of an edge. Chosen.
    var smoothness = 1.0
    /// Weight of the mean color of all photos. Chosen.
    var consensus = 0.02
    /// Weight that fixes the color interpolated where no photo sees the surface. Chosen: outweighs
    /// all others.
    var interpolated = 1000.0
  }

  var options = Options()

  /// Solves for the offsets of all shares in `weights`.
  func run(
    _ rated: RatedViews, weights: CornerWeights, mesh: Mesh, topology: MeshTopology,
    _ context: StageContext
  ) throws -> LevelingOffsets {
    let nodes = Nodes(weights, mesh)
    let vertexColors = try VertexColors(rated, mesh, topology).filled(context.control)
    let areas = mesh.triangleAreas()
    let colors = nodes.items.map { node -> SIMD3<Float>? in
      node.view < 0
        ? vertexColors[node.vertex]
        : Self.color(of: node.vertex, in: node.view, rated, topology, areas)
    }
    var system = SparseLeastSquares(unknownCount: nodes.items.count)
    for vertex in mesh.positions.indices {
      addSeams(nodes.range(of: vertex), colors, nodes, vertexColors[vertex], to: &system)
    }
    for edge in topology.edges {
      for low in nodes.range(of: Int(edge.low)) {
        guard let high = nodes.index(of: Int(edge.high), view: nodes.items[low].view)
        else { continue }
        system.add(low, minus: high, weight: options.smoothness)
      }
    }
    let solution = try system.solve(context.control)
    var result = LevelingOffsets(
      offsets: Array(repeating: .zero, count: weights.shares.count), vertexColors: vertexColors)
    for corner in 0..<(3 * mesh.triangles.count) {
      let vertex = mesh.triangles[corner / 3].vertices[corner % 3]
      for index in weights.shares(of: corner).indices {
        let view = weights.shares[index].view
        if view < 0 {
          result.offsets[index] = vertexColors[vertex]
        } else if let node = nodes.index(of: vertex, view: view) {
          result.offsets[index] = SIMD3<Float>(solution[node])
        }
      }
    }
    return result
  }

  /// Adds the consensus and seam equations of one vertex, whose unknowns are `range`.
  private func addSeams(
    _ range: Range<Int>, _ colors: [SIMD3<Float>?], _ nodes: Nodes, _ agreed: SIMD3<Float>,
    to system: inout SparseLeastSquares
  ) {
    for a in range {
      let view = nodes.items[a].view
      guard let color = colors[a] else {
        system.add(a, value: .zero, weight: options.consensus)
        continue
      }
      // The interpolated color is fixed; photos adapt to it.
      let weight = view < 0 ? options.interpolated : options.consensus
      system.add(a, value: SIMD3<Double>(agreed - color), weight: weight)
      for b in range.lowerBound..<a {
        guard let other = colors[b] else { continue }
        system.add(a, minus: b, value: SIMD3<Double>(other - color), weight: options.seam)
      }
    }
  }

  /// A vertex's color in a view: the area-weighted mean over its triangles.
  private static func color(
    of vertex: Int, in view: Int32, _ rated: RatedViews, _ topology: MeshTopology,
    _ areas: [Float]
  ) -> SIMD3<Float>? {
    var (sum, weight) = (SIMD3<Float>.zero, Float(0))
    for face in topology.triangles(around: vertex) {
      guard let entry = rated.view(view, of: Int(face)) else { continue }
      sum += entry.color * areas[Int(face)]
      weight += areas[Int(face)]
    }
    return weight > 0 ? sum / weight : nil
  }
}

/// The unknowns: every view that colors a corner at a vertex.
private struct Nodes {
  private(set) var items: [(vertex: Int, view: Int32)] = []
  private var offsets: [Int32] = [0]

  init(_ weights: CornerWeights, _ mesh: Mesh) {
    var views = [[Int32]](repeating: [], count: mesh.positions.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      for (corner, vertex) in triangle.vertices.enumerated() {
        for share in weights.shares(of: 3 * face + corner)
        where !views[vertex].contains(share.view) {
          views[vertex].append(share.view)
        }
      }
    }
    for (vertex, list) in views.enumerated() {
      items += list.sorted().map { (vertex, $0) }
      offsets.append(Int32(items.count))
    }
  }

  /// The unknowns of a vertex.
  func range(of vertex: Int) -> Range<Int> { Int(offsets[vertex])..<Int(offsets[vertex + 1]) }

  /// The unknown of a vertex and a view; nil if the view doesn't color the vertex.
  func index(of vertex: Int, view: Int32) -> Int? {
    range(of: vertex).first { items[$0].view == view }
  }
}

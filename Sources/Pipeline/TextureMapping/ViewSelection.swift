import Kernels
import SceneModel

/// Selects the photo that colors each triangle: a Markov random field with the candidates' quality
/// as data term and the Potts model as smoothness term (Lempitsky and Ivanov, CVPR 2007).
struct ViewSelection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Cost of a label change along an edge of mean length; a triangle's worst photo costs at most
    /// 1. Chosen.
    var smoothness: Float = 0.5
    /// Bounds of an edge's length relative to the mean, for this cost. Chosen.
    var lengthRange: ClosedRange<Float> = 0.2...3
    /// Number of iterations of TRW-S. Measured: with the kernel's order of the triangles, 22 reach
    /// the energy of 20 in ascending order (boot, 3 million triangles).
    var iterations = 22
  }

  var options = Options()

  /// The view of each triangle; −1 if no photo sees it.
  func run(
    _ rated: RatedViews, mesh: Mesh, topology: MeshTopology, _ context: StageContext
  ) throws -> [Int32] {
    var selection = LabelSelection()
    selection.reserve(
      nodes: mesh.triangles.count,
      candidates: rated.views.blocks.reduce(0) { $0 + $1.entries.count },
      edges: topology.edges.count)
    try addNodes(rated, to: &selection, context)
    let lengths = topology.edges.map { edge in
      (mesh.positions[Int(edge.low)] - mesh.positions[Int(edge.high)]).length
    }
    let mean = lengths.reduce(0, +) / Float(max(1, lengths.count))
    for (edge, length) in zip(topology.edges, lengths) where edge.second >= 0 {
      let bounds = options.lengthRange
      let relative =
        mean > 0 ? min(max(length / mean, bounds.lowerBound), bounds.upperBound) : 1
      selection.addEdge(
        UInt32(edge.first), UInt32(edge.second), weight: options.smoothness * relative)
    }
    let labels = try selection.run(iterations: options.iterations, context.control)
    context.notes.record("unseenTriangles", Double(labels.count { $0 < 0 }))
    return labels
  }

  /// Adds the triangles as nodes, with their views as candidates.
  private func addNodes(
    _ rated: RatedViews, to selection: inout LabelSelection, _ context: StageContext
  ) throws {
    let control = context.part(from: 0, to: 0).control
    let nodes = try control.parallelMap(rated.views.blocks.count) { index in
      let block = rated.views.blocks[index]
      var costs = block.entries.map(\.quality)
      for face in 0..<block.faceCount {
        let range = block.range(of: face)
        let best = range.reduce(Float(0)) { max($0, costs[$1]) }
        for entry in range { costs[entry] = best > 0 ? 1 - costs[entry] / best : 0 }
      }
      return (
        counts: (0..<block.faceCount).map { block.range(of: $0).count },
        labels: block.entries.map(\.view), costs: costs
      )
    }
    for part in nodes {
      selection.addNodes(candidateCounts: part.counts, labels: part.labels, costs: part.costs)
    }
  }
}

import Kernels
import SceneModel

/// Selects the photo that colors each triangle: a Markov random field with the candidates' quality
/// as data term and the Potts model as smoothness term (Lempitsky and Ivanov, CVPR 2007).
struct ViewSelection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Cost of a label change along an edge of mean length; a triangle's worst photo costs at most
    /// 1.
    var smoothness: Float = 0.5
    /// Bounds of an edge's length relative to the mean, for this cost.
    var lengthRange: ClosedRange<Float> = 0.2...3
    /// Number of iterations of TRW-S.
    var iterations = 20
  }

  var options = Options()

  /// The view of each triangle; −1 if no photo sees it.
  func run(
    _ rated: RatedViews, mesh: Mesh, topology: MeshTopology, _ context: StageContext
  ) throws -> [Int32] {
    var selection = LabelSelection()
    for face in 0..<rated.views.faceCount {
      let range = rated.views.range(of: face)
      let best = range.map { rated.qualities[$0] }.max() ?? 0
      selection.addNode(
        range.map { index in
          let share = best > 0 ? rated.qualities[index] / best : 1
          return (label: rated.views.entries[index].view, cost: 1 - share)
        })
    }
    let lengths = topology.edges.map { edge in
      (mesh.positions[Int(edge.low)] - mesh.positions[Int(edge.high)]).length
    }
    let mean = lengths.reduce(0, +) / Float(max(1, lengths.count))
    for (edge, length) in zip(topology.edges, lengths) where edge.second >= 0 {
      let bounds = options.lengthRange
      let relative =
        mean > 0 ? min(max(length / mean, bounds.lowerBound), bounds.upperBound) : 1
      selection.edges.append(
        .init(
          UInt32(edge.first), UInt32(edge.second), weight: options.smoothness * relative))
    }
    let labels = try selection.run(iterations: options.iterations, context.control)
    context.notes.record("unseenTriangles", Double(labels.count { $0 < 0 }))
    return labels
  }
}

import CKernels

/// Assigns one label to each node of a graph, at a cost per label and per edge between different
/// labels.
///
/// Potts model, minimized by sequential tree-reweighted message passing (Kolmogorov, PAMI 2006).
package struct LabelSelection: Sendable {
  /// A pair of nodes that should have the same label.
  package struct Edge: Hashable, Sendable {
    /// Index of a node.
    package var a: UInt32
    /// Index of the other node.
    package var b: UInt32
    /// Cost of different labels at the two ends.
    package var weight: Float

    package init(_ a: UInt32, _ b: UInt32, weight: Float) {
      (self.a, self.b, self.weight) = (a, b, weight)
    }
  }

  /// Candidates of node i are `offsets[i]..<offsets[i + 1]`.
  private var offsets: [UInt32] = [0]
  private var labels: [Int32] = []
  private var costs: [Float] = []
  /// The smoothness terms.
  package var edges: [Edge] = []

  package init() {}

  /// Adds the next node; labels must be in ascending order.
  package mutating func addNode(_ candidates: some Sequence<(label: Int32, cost: Float)>) {
    for candidate in candidates {
      labels.append(candidate.label)
      costs.append(candidate.cost)
    }
    offsets.append(UInt32(labels.count))
  }

  /// The label of each node; −1 for nodes without candidates.
  package func run(iterations: Int, _ control: KernelControl) throws -> [Int32] {
    let count = offsets.count - 1
    var choices = [Int32](repeating: -1, count: count)
    let (offsets, labels) = (KernelArray(offsets), KernelArray(labels))
    let (costs, pairs) = (KernelArray(costs), KernelArray(edges.flatMap { [$0.a, $0.b] }))
    let weights = KernelArray(edges.lazy.map(\.weight))
    try withExtendedLifetime((offsets, labels, costs, pairs, weights)) {
      var problem = ck_label_problem(
        node_count: count, offsets: offsets.base, labels: labels.base, costs: costs.base,
        edge_count: weights.count, edges: pairs.base, edge_weights: weights.base)
      try withKernel(control) { ck_select_labels(&problem, iterations, $0, &choices) }
    }
    return choices.enumerated().map { node, choice in
      choice < 0 ? -1 : self.labels[Int(self.offsets[node]) + Int(choice)]
    }
  }
}

import CKernels

/// Assigns one label to each node of a graph, at a cost per label and per edge between different
/// labels.
///
/// Potts model, minimized by tree-reweighted message passing (TRW-S; Kolmogorov, PAMI 2006).
package struct LabelSelection: Sendable {
  /// Candidates of node i are `offsets[i]..<offsets[i + 1]`.
  private var offsets: [UInt32] = [0]
  private var labels: [Int32] = []
  private var costs: [Float] = []
  private var edges: [ck_label_edge] = []

  package init() {}

  private var nodeCount: Int { offsets.count - 1 }

  /// Makes room for `edges` edges, and nodes with a total number of candidates.
  package mutating func reserve(nodes: Int, candidates: Int, edges: Int) {
    offsets.reserveCapacity(nodes + 1)
    labels.reserveCapacity(candidates)
    costs.reserveCapacity(candidates)
    self.edges.reserveCapacity(edges)
  }

  /// Adds nodes with the given numbers of candidates; `labels` and `costs` hold the candidates of
  /// all, the labels in ascending order for each node.
  package mutating func addNodes(candidateCounts: [Int], labels: [Int32], costs: [Float]) {
    precondition(
      labels.count == costs.count && labels.count == candidateCounts.reduce(0, +),
      "candidates are missing")
    self.labels += labels
    self.costs += costs
    for count in candidateCounts { offsets.append(offsets[offsets.count - 1] + UInt32(count)) }
  }

  /// Adds a pair of nodes that should have the same label; `weight` is the cost of different ones.
  package mutating func addEdge(_ a: UInt32, _ b: UInt32, weight: Float) {
    edges.append(ck_label_edge(nodes: (a, b), weight: weight))
  }

  /// The label of each node; −1 for nodes without candidates. Doesn't depend on the number of
  /// threads.
  package func run(iterations: Int, _ control: KernelControl) throws -> [Int32] {
    var choices = [Int32](repeating: -1, count: nodeCount)
    try withProblem { problem in
      try withKernel(control) { ck_select_labels(&problem, iterations, $0, &choices) }
    }
    for (node, choice) in choices.enumerated() where choice >= 0 {
      choices[node] = labels[Int(offsets[node]) + Int(choice)]
    }
    return choices
  }

  /// Calls `body` with the C representation, valid only during the call; the arrays are too large
  /// to copy.
  private func withProblem(_ body: (inout ck_label_problem) throws -> Void) rethrows {
    try offsets.withUnsafeBufferPointer { offsets in
      try labels.withUnsafeBufferPointer { labels in
        try costs.withUnsafeBufferPointer { costs in
          try edges.withUnsafeBufferPointer { edges in
            var problem = ck_label_problem(
              node_count: nodeCount, offsets: offsets.baseAddress, labels: labels.baseAddress,
              costs: costs.baseAddress, edge_count: edges.count, edges: edges.baseAddress)
            try body(&problem)
          }
        }
      }
    }
  }
}

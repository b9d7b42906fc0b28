import Kernels
import TestSupport
import Testing

/// Label selection on graphs of several blocks.
@Suite struct LabelSelectionTests {
  /// A random problem on a grid whose nodes have different candidates.
  private struct Grid {
    /// 40,000 nodes: three blocks of the kernel.
    static let side = 200

    var candidates: [[(label: Int32, cost: Float)]] = []
    var edges: [(a: Int, b: Int, weight: Float)] = []

    init(seed: UInt64) {
      var generator = SeededGenerator(seed: seed)
      for node in 0..<Self.side * Self.side {
        candidates.append([])
        // Like photos, most labels are candidates in a part of the grid; some nodes have none.
        let isCovered = Int.random(in: 0..<50, using: &generator) > 0
        for label in 0..<6 where isCovered {
          guard Int.random(in: 0..<20, using: &generator) < (label + node / 4000) % 20 else {
            continue
          }
          candidates[node].append((Int32(label), .random(in: 0...1, using: &generator)))
        }
        for other in [node - 1, node - Self.side] where other >= 0 {
          guard other != node - 1 || node % Self.side > 0 else { continue }
          edges.append((other, node, .random(in: 0...0.6, using: &generator)))
        }
      }
    }

    var selection: LabelSelection {
      var selection = LabelSelection()
      selection.reserve(
        nodes: candidates.count, candidates: candidates.reduce(0) { $0 + $1.count },
        edges: edges.count)
      selection.addNodes(
        candidateCounts: candidates.map(\.count),
        labels: candidates.flatMap { $0.map(\.label) },
        costs: candidates.flatMap { $0.map(\.cost) })
      for edge in edges { selection.addEdge(UInt32(edge.a), UInt32(edge.b), weight: edge.weight) }
      return selection
    }

    func energy(of labels: [Int32]) -> Double {
      var energy = 0.0
      for (label, candidates) in zip(labels, candidates) {
        energy += Double(candidates.first { $0.label == label }?.cost ?? 0)
      }
      for edge in edges where labels[edge.a] >= 0 && labels[edge.b] >= 0 {
        if labels[edge.a] != labels[edge.b] { energy += Double(edge.weight) }
      }
      return energy
    }

    /// Iterated conditional modes from the cheapest labels, until nothing changes.
    func locallyBest() -> [Int32] {
      var labels = candidates.map { node in node.min { $0.cost < $1.cost }?.label ?? -1 }
      var neighbors = [[(node: Int, weight: Float)]](repeating: [], count: candidates.count)
      for edge in edges {
        neighbors[edge.a].append((edge.b, edge.weight))
        neighbors[edge.b].append((edge.a, edge.weight))
      }
      var isChanged = true
      while isChanged {
        isChanged = false
        for node in candidates.indices where !candidates[node].isEmpty {
          let costs = candidates[node].map { candidate in
            neighbors[node].reduce(candidate.cost) { sum, neighbor in
              let other = labels[neighbor.node]
              return sum + (other >= 0 && other != candidate.label ? neighbor.weight : 0)
            }
          }
          let least = costs.min() ?? 0
          guard let current = candidates[node].firstIndex(where: { $0.label == labels[node] }),
            costs[current] > least + 1e-5, let best = costs.firstIndex(of: least)
          else { continue }
          labels[node] = candidates[node][best].label
          isChanged = true
        }
      }
      return labels
    }
  }

  @Test(arguments: [1, 2, 3] as [UInt64])
  func labelsDoNotDependOnThreads(seed: UInt64) throws {
    let grid = Grid(seed: seed)
    let labels = try grid.selection.run(iterations: 5, KernelControl())
    for threads in [2, 3, 8] {
      let control = KernelControl(threadCount: threads)
      #expect(try grid.selection.run(iterations: 5, control) == labels)
    }
    for (label, candidates) in zip(labels, grid.candidates) {
      #expect(candidates.isEmpty ? label == -1 : candidates.contains { $0.label == label })
    }
  }

  @Test(arguments: [1, 2, 3] as [UInt64])
  func energyIsBelowThatOfALocalSearch(seed: UInt64) throws {
    let grid = Grid(seed: seed)
    let labels = try grid.selection.run(iterations: 20, KernelControl(threadCount: 2))
    #expect(grid.energy(of: labels) < 0.99 * grid.energy(of: grid.locallyBest()))
  }

  /// More iterations lower the energy; the last ones little.
  @Test func iterationsConverge() throws {
    let grid = Grid(seed: 4)
    let energies = try [1, 5, 20, 40].map { iterations in
      grid.energy(of: try grid.selection.run(iterations: iterations, KernelControl()))
    }
    #expect(energies[1] < energies[0])
    #expect(energies[2] < energies[1])
    #expect(abs(energies[3] - energies[2]) < 0.005 * energies[2])
  }

  @Test func aRunCanBeCanceled() {
    let flag = CancellationFlag()
    let control = KernelControl(threadCount: 2, flag: flag) { if $0 > 0.3 { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try Grid(seed: 5).selection.run(iterations: 20, control)
    }
  }
}

import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct TextureSolversTests {
  private func chain(_ costs: [[(label: Int32, cost: Float)]], weight: Float) -> LabelSelection {
    var selection = LabelSelection()
    selection.addNodes(
      candidateCounts: costs.map(\.count), labels: costs.flatMap { $0.map(\.label) },
      costs: costs.flatMap { $0.map(\.cost) })
    for index in 1..<costs.count {
      selection.addEdge(UInt32(index - 1), UInt32(index), weight: weight)
    }
    return selection
  }

  @Test func withoutSmoothnessEveryNodeTakesItsBestLabel() throws {
    var costs: [[(label: Int32, cost: Float)]] = []
    for node in 0..<10 {
      costs.append(
        (0..<4).map { (label: Int) -> (label: Int32, cost: Float) in
          (Int32(label), Float((label * 7 + node * 3) % 11))
        })
    }
    let labels = try chain(costs, weight: 0).run(iterations: 5, KernelControl())
    for (label, candidates) in zip(labels, costs) {
      #expect(label == candidates.min { $0.cost < $1.cost }?.label)
    }
  }

  /// On a chain, dynamic programming gives the optimum; TRW-S solves trees exactly.
  @Test func aChainIsSolvedExactly() throws {
    var generator = SeededGenerator(seed: 3)
    var costs: [[(label: Int32, cost: Float)]] = []
    for _ in 0..<40 {
      var candidates: [(label: Int32, cost: Float)] = []
      for label in 0..<5 {
        candidates.append((Int32(label), Float.random(in: 0...1, using: &generator)))
      }
      costs.append(candidates)
    }
    let weight: Float = 0.3
    let labels = try chain(costs, weight: weight).run(iterations: 30, KernelControl())
    var energy: Float = 0
    for (node, label) in labels.enumerated() {
      energy += costs[node][Int(label)].cost
      if node > 0, labels[node - 1] != label { energy += weight }
    }
    var best = costs[0].map(\.cost)
    for candidates in costs.dropFirst() {
      let least = best.min() ?? 0
      best = zip(best, candidates).map { min($0, least + weight) + $1.cost }
    }
    #expect(abs(energy - (best.min() ?? 0)) < 1e-3)
  }

  @Test func nodesWithoutCandidatesStayUnlabeled() throws {
    let labels = try chain(
      [[(label: 3, cost: 0), (label: 9, cost: 0.1)], [], [(label: 9, cost: 0)]], weight: 5
    ).run(iterations: 10, KernelControl())
    #expect(labels == [3, -1, 9])
  }

  @Test func chainsOfDifferencesAreSolved() throws {
    var system = SparseLeastSquares(unknownCount: 50)
    system.add(0, value: [1, 2, 3], weight: 2)
    for index in 1..<50 { system.add(index, minus: index - 1, value: [1, 0, -1], weight: 0.5) }
    let solution = try system.solve(tolerance: 1e-12, KernelControl())
    for (index, value) in solution.enumerated() {
      #expect((value - [1 + Double(index), 2, 3 - Double(index)]).length < 1e-5)
    }
  }
}

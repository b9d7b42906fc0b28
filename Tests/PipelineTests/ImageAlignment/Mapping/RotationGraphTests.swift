import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct RotationGraphTests {
  private func graph(
    _ photoCount: Int, _ pairs: [(Int32, Int32)], rotations: [Quaternion]? = nil
  ) -> RotationGraph {
    RotationGraph(
      photoCount: photoCount,
      pairs: pairs.map { first, second in
        let relative =
          rotations.map { $0[Int(second)] * $0[Int(first)].conjugate } ?? .identity
        return RelativeRotation(first: first, second: second, rotation: relative)
      })
  }

  @Test func bridgeSeparatesParts() {
    // A triangle and a square, joined by one pair; photo 7 has none.
    let graph = graph(
      8, [(0, 1), (0, 2), (1, 2), (2, 3), (3, 4), (3, 6), (4, 5), (5, 6)])
    #expect(graph.largestTwoConnectedPart() == [3, 4, 5, 6])
  }

  @Test func chainHasNoTwoConnectedPart() {
    #expect(graph(4, [(0, 1), (1, 2), (2, 3)]).largestTwoConnectedPart().count == 1)
    #expect(graph(0, []).largestTwoConnectedPart().isEmpty)
    #expect(graph(0, []).tripletCounts(limit: 0.1).consistentShare == 1)
  }

  @Test func inconsistentPairIsDropped() {
    var random = SeededGenerator(seed: 2)
    let rotations = (0..<6).map { _ in Quaternion(angle: random.uniform(), axis: random.normal3()) }
    let all = (0..<6).flatMap { a in ((a + 1)..<6).map { (Int32(a), Int32($0)) } }
    var graph = graph(6, all, rotations: rotations)
    var triplets = graph.tripletCounts(limit: 0.01)
    #expect(triplets.consistentShare == 1)
    #expect(graph.consistent(triplets, minimumShare: 0.5).pairs.count == 15)
    graph.pairs[4].rotation = Quaternion(angle: 0.5, axis: [1, 0, 0]) * graph.pairs[4].rotation
    triplets = graph.tripletCounts(limit: 0.1)
    // The pair is part of 4 of the 20 triplets.
    #expect(triplets.consistentShare == 0.8)
    let kept = graph.consistent(triplets, minimumShare: 0.5)
    #expect(kept.pairs == graph.pairs.indices.filter { $0 != 4 }.map { graph.pairs[$0] })
  }

  @Test func treeFollowsTheHeaviestPairs() {
    var random = SeededGenerator(seed: 4)
    let rotations = (0..<5).map { _ in Quaternion(angle: random.uniform(), axis: random.normal3()) }
    var graph = graph(5, [(0, 1), (0, 4), (1, 2), (2, 3), (3, 4)], rotations: rotations)
    for index in graph.pairs.indices { graph.pairs[index].weight = 10 }
    graph.pairs[1].weight = 1
    graph.pairs[1].rotation = .identity
    let found = graph.treeRotations()
    for (rotation, truth) in zip(found, rotations) {
      #expect((rotation * (truth * rotations[0].conjugate).conjugate).angle < 1e-9)
    }
  }
}

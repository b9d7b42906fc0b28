import SceneModel
import Testing

@testable import Pipeline

/// A graph of selected features, with the numbers of all features.
@Suite struct ViewGraphRenumberingTests {
  private func pair(_ matches: [(Int32, Int32)]) -> VerifiedPair {
    VerifiedPair(
      pair: PhotoPair(ID(0), ID(1)), model: .essential, secondFromFirst: nil,
      matches: matches.map { FeatureMatch(first: $0.0, second: $0.1) }, medianAngle: 0)
  }

  @Test func allMatchesAndFlagsAreRenumbered() {
    var graph = ViewGraph(photoCount: 2, pairs: [pair([(0, 1), (2, 0)])])
    graph.motions = [
      TwoMotions(
        pair: PhotoPair(ID(0), ID(1)), bodies: [pair([(1, 1)]), pair([(0, 0)])],
        isFirstStatic: true)
    ]
    graph.rejected = [
      RejectedPair(pair: PhotoPair(ID(0), ID(1)), matches: 1, needed: 20, weak: pair([(1, 0)]))
    ]
    graph.omitsSurroundings = true
    graph.surroundings = [[true, false, true], [false, true]]

    let result = graph.renumbered([[1, 4, 5], [0, 3]], featureCounts: [6, 4])
    #expect(result.pairs == [pair([(1, 3), (5, 0)])])
    #expect(result.motions[0].bodies == [pair([(4, 3)]), pair([(1, 0)])])
    #expect(result.motions[0].isFirstStatic)
    #expect(result.rejected[0].weak == nil)
    #expect(
      result.surroundings == [
        [false, true, false, false, false, true], [false, false, false, true],
      ])
  }

  @Test func withoutSurroundingsThereAreNoFlags() {
    let graph = ViewGraph(photoCount: 2, pairs: [pair([(0, 0)])])
    #expect(graph.renumbered([[2], [3]], featureCounts: [4, 4]).surroundings.isEmpty)
  }
}

import SceneModel

extension PlacementDetection {
  /// The groups by what photos show of the points that a map predicts, and by pairs that show two
  /// motions. Photos taken before and after a move have nearly the same pose in a map of the
  /// surroundings, or in one of the object, but show different things. Photos without a pose are a
  /// group of their own if they match.
  func groups(
    _ evidence: [SceneAmbiguityCheck.Evidence], _ reconstruction: Reconstruction, _ graph: ViewGraph
  ) -> [[Int]] {
    // Matches of a moving object do not depend on its surroundings.
    var links = links(of: graph.isObjectOnly ? [] : graph.motions)
    let moved = MovedPoints(evidence)
    for one in evidence {
      links[one.pair, default: Link()].evidence +=
        moved.count(one.present) - options.absenceWeight * moved.count(one.absent)
    }
    for (pair, count) in moved.sightings(reconstruction) {
      links[pair, default: Link()].evidence += count
    }
    for pair in graph.pairs where reconstruction.isPosedAlike(pair.pair) {
      links[pair.pair, default: Link()].matches += pair.matches.count
    }
    return groups(links, photoCount: graph.photoCount)
  }
}

extension Reconstruction {
  /// Whether both photos have a pose, or neither has.
  fileprivate func isPosedAlike(_ pair: PhotoPair) -> Bool {
    (poses[pair.first.index] == nil) == (poses[pair.second.index] == nil)
  }
}

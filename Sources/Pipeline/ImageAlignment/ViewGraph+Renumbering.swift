import SceneModel

extension ViewGraph {
  /// The graph with other numbers of the features: `numbers` has the new one of each, by photo, and
  /// `featureCounts` how many there are.
  func renumbered(_ numbers: [[Int]], featureCounts: [Int]) -> ViewGraph {
    var result = self
    result.pairs = pairs.map { $0.renumbered(numbers) }
    // Their features are not needed any more.
    for index in rejected.indices { result.rejected[index].weak = nil }
    for index in motions.indices {
      result.motions[index].bodies = motions[index].bodies.map { $0.renumbered(numbers) }
    }
    if omitsSurroundings {
      result.surroundings = featureCounts.map { [Bool](repeating: false, count: $0) }
      for (photo, flags) in surroundings.enumerated() {
        for (feature, flag) in flags.enumerated() {
          result.surroundings[photo][numbers[photo][feature]] = flag
        }
      }
    }
    return result
  }
}

extension VerifiedPair {
  fileprivate func renumbered(_ numbers: [[Int]]) -> VerifiedPair {
    var result = self
    result.matches = matches.map { match in
      FeatureMatch(
        first: Int32(numbers[pair.first.index][Int(match.first)]),
        second: Int32(numbers[pair.second.index][Int(match.second)]))
    }
    return result
  }
}

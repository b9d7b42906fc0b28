import SceneModel

extension ViewGraph {
  /// The graph with other numbers of the features: `numbers` has the new one of each, by photo.
  func renumbered(_ numbers: [[Int]]) -> ViewGraph {
    var result = self
    for index in pairs.indices {
      let (first, second) = (pairs[index].pair.first.index, pairs[index].pair.second.index)
      result.pairs[index].matches = pairs[index].matches.map {
        FeatureMatch(
          first: Int32(numbers[first][Int($0.first)]),
          second: Int32(numbers[second][Int($0.second)]))
      }
    }
    // Their features are not needed any more.
    for index in rejected.indices { result.rejected[index].weak = nil }
    return result
  }
}

import SceneModel

extension ViewGraph {
  /// The connected components of the verified pairs, each in ascending order, larger groups first.
  package var connectedGroups: [[Int]] {
    var sets = DisjointSets(count: photoCount)
    for pair in pairs { sets.join(pair.pair.first.index, pair.pair.second.index) }
    return sets.groups().sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// The graph with the pairs of some of the photos only.
  func restricted(to group: [Int]) -> ViewGraph {
    let members = Set(group)
    func isInside(_ pair: PhotoPair) -> Bool {
      members.contains(pair.first.index) && members.contains(pair.second.index)
    }
    var result = self
    result.pairs = pairs.filter { isInside($0.pair) }
    result.rejected = rejected.filter { isInside($0.pair) }
    result.motions = motions.filter { isInside($0.pair) }
    return result
  }
}

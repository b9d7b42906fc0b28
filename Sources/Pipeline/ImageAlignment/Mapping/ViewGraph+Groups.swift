import SceneModel

extension ViewGraph {
  /// The connected components of the verified pairs, each in ascending order, larger groups first.
  package var connectedGroups: [[Int]] {
    var sets = DisjointSets(count: photoCount)
    for pair in pairs { sets.join(pair.pair.first.index, pair.pair.second.index) }
    return sets.groups().sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }
}

import SceneModel

extension ViewGraph {
  /// The connected components of the verified pairs, each in ascending order, larger groups first.
  package var connectedGroups: [[Int]] {
    var sets = DisjointSets(count: photoCount)
    for pair in pairs { sets.join(pair.pair.first.index, pair.pair.second.index) }
    return sets.groups().sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// The verified partners of each photo, in ascending order.
  var partners: [[Int]] {
    var partners = [[Int]](repeating: [], count: photoCount)
    for pair in pairs {
      partners[pair.pair.first.index].append(pair.pair.second.index)
      partners[pair.pair.second.index].append(pair.pair.first.index)
    }
    return partners.map { $0.sorted() }
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

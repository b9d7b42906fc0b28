import SceneModel

/// Which photos match, for the report of a run. Recorded before alignment can fail, so that the
/// report of a run without a model shows what is missing between its photos.
///
/// The lists of pairs are columns of one table, sorted by the two photos.
package struct MatchRecord: Hashable, Codable, Sendable {
  /// Number of features by photo ID.
  package var features: [Int] = []
  /// Photo IDs of each pair, `first < second`.
  package var first: [Int] = []
  package var second: [Int] = []
  /// Number of matches that agree with one two-view geometry.
  package var matches: [Int] = []
  /// 0 for a pair that is used, else the number of matches that would have sufficed.
  package var needed: [Int] = []
  /// Median triangulation angle of the matches in degrees; 0 if unknown.
  package var degrees: [Double] = []

  package init() {}

  /// `features` and `graph` are those that a map is made from.
  package init(_ features: [FeatureSet], _ graph: ViewGraph) {
    self.features = features.map(\.count)
    let used = graph.pairs.map {
      Row(pair: $0.pair, matches: $0.matches.count, needed: 0, angle: $0.medianAngle)
    }
    let rejected = graph.rejected.map {
      Row(pair: $0.pair, matches: $0.matches, needed: $0.needed, angle: 0)
    }
    for row in (used + rejected).sorted(by: { ($0.pair, $0.needed) < ($1.pair, $1.needed) }) {
      first.append(row.pair.first.index)
      second.append(row.pair.second.index)
      matches.append(row.matches)
      needed.append(row.needed)
      degrees.append((row.angle * 180 / .pi * 100).rounded() / 100)
    }
  }

  private struct Row {
    var pair: PhotoPair
    var matches: Int
    var needed: Int
    var angle: Double
  }

  /// The photo IDs that pairs in use connect, each group in ascending order, larger groups first.
  package var groups: [[Int]] {
    var sets = DisjointSets(count: features.count)
    for (row, needed) in needed.enumerated() where needed == 0 {
      sets.join(first[row], second[row])
    }
    return sets.groups().sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// The number of photos that each photo matches, by photo ID.
  package var partners: [Int] {
    var counts = [Int](repeating: 0, count: features.count)
    for (row, needed) in needed.enumerated() where needed == 0 {
      counts[first[row]] += 1
      counts[second[row]] += 1
    }
    return counts
  }
}

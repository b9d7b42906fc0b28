import SceneModel

/// Divides photos in the order of capture into intervals, between which the object was moved.
///
/// For each number of intervals, dynamic programming finds the division with the highest sum of
/// evidence within them.
struct CaptureIntervals {
  private let options: PlacementDetection.Options
  private let photoCount: Int
  /// The evidence between each photo and others that show the object in the same placement
  /// (positive) or in another one (negative).
  private var evidence: [[(photo: Int, value: Int)]]

  /// Nil without evidence against a single placement.
  init?(
    _ links: [PhotoPair: PlacementDetection.Link], photoCount: Int,
    _ options: PlacementDetection.Options
  ) {
    guard links.values.contains(where: { $0.evidence < 0 }) else { return nil }
    (self.options, self.photoCount) = (options, photoCount)
    evidence = Array(repeating: [], count: photoCount)
    for (pair, link) in links where link.evidence != 0 {
      evidence[pair.first.index].append((pair.second.index, link.evidence))
      evidence[pair.second.index].append((pair.first.index, link.evidence))
    }
  }

  /// The division into the least intervals that explains the evidence; nil if none does.
  func division() -> [[Int]]? {
    let divisions = divisions()
    return divisions.dropFirst().first {
      $0.score > divisions[0].score && isExplained(by: $0.groups) && isWitnessed($0.groups)
    }?.groups
  }

  /// The best division for each number of intervals.
  private func divisions() -> [(groups: [[Int]], score: Int)] {
    let most = min(options.maximumIntervals, photoCount / options.minimumPhotos)
    guard most > 0 else { return [] }
    let limit = options.maximumEvidence
    // By the number of intervals and their end: the score, and the start of the last one.
    let row = [(score: Int?, start: Int)](repeating: (nil, 0), count: photoCount + 1)
    var best = [[(score: Int?, start: Int)]](repeating: row, count: most + 1)
    best[0][0].score = options.boundaryCost
    for end in stride(from: 1, through: photoCount, by: 1) {
      var within = 0
      for first in stride(from: end - 1, through: 0, by: -1) {
        // `within` is the sum over the pairs of first..<end.
        for other in evidence[first] where other.photo > first && other.photo < end {
          within += min(limit, max(-limit, other.value))
        }
        guard end - first >= options.minimumPhotos else { continue }
        for count in 1...most {
          guard let before = best[count - 1][first].score else { continue }
          let score = before + within - options.boundaryCost
          if score > best[count][end].score ?? .min { best[count][end] = (score, first) }
        }
      }
    }
    return (1...most).compactMap { count in
      guard let score = best[count][photoCount].score else { return nil }
      var (groups, end) = ([[Int]](), photoCount)
      for count in stride(from: count, to: 0, by: -1) {
        let start = best[count][end].start
        groups.append(Array(start..<end))
        end = start
      }
      return (groups.reversed(), score)
    }
  }

  /// Whether little of the evidence that most photos have against a single placement remains.
  private func isExplained(by groups: [[Int]]) -> Bool {
    let remainders = groups.flatMap { group in
      group.compactMap { photo -> Double? in
        let against = evidence[photo].filter { $0.value < 0 }
        guard !against.isEmpty else { return nil }
        func sum(_ part: [(photo: Int, value: Int)]) -> Int { part.reduce(0) { $0 + $1.value } }
        let within = against.filter { group[0]...group[group.count - 1] ~= $0.photo }
        return Double(sum(within)) / Double(sum(against))
      }
    }
    let byChance = 1 / Double(groups.count)
    return (remainders.upperMedian ?? 0) <= options.maximumRemainder * byChance
  }

  /// Whether several photos contradict the other side of each boundary.
  private func isWitnessed(_ groups: [[Int]]) -> Bool {
    func witnesses(_ group: [Int], against other: [Int]) -> Int {
      group.count { photo in
        let across = evidence[photo].filter { other[0]...other[other.count - 1] ~= $0.photo }
        return across.reduce(0) { $0 + $1.value } < 0
      }
    }
    return zip(groups, groups.dropFirst()).allSatisfy { left, right in
      min(witnesses(left, against: right), witnesses(right, against: left))
        >= options.minimumWitnesses
    }
  }
}

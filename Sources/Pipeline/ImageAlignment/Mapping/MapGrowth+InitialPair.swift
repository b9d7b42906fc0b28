import Kernels
import SceneModel

extension MapGrowth {
  /// A map of the best initial pair that can be triangulated.
  func initialMap(
    within group: [Int], _ isTaken: [Bool], _ used: inout Set<PhotoPair>
  ) throws -> SparseMap? {
    let members = Set(group)
    var trials = 0
    for level in options.initialPairLevels {
      for pair in candidates(level, members, isTaken) where !used.contains(pair.pair) {
        guard trials < options.initialPairTrials else { return nil }
        trials += 1
        used.insert(pair.pair)
        if let map = try begin(with: pair, level) { return map }
      }
    }
    return nil
  }

  /// Pairs that satisfy a level, the most promising first.
  private func candidates(
    _ level: IncrementalMapping.Options.InitialPairLevel, _ members: Set<Int>, _ isTaken: [Bool]
  ) -> [VerifiedPair] {
    let scored = graph.pairs.enumerated().compactMap {
      index, pair -> (score: Double, index: Int, pair: VerifiedPair)? in
      let ids = [pair.pair.first.index, pair.pair.second.index]
      let degrees = pair.medianAngle * 180 / .pi
      guard
        pair.secondFromFirst != nil, pair.matches.count >= level.matches,
        degrees >= level.angleDegrees, ids.allSatisfy({ members.contains($0) && !isTaken[$0] })
      else { return nil }
      let certainty = pair.model == .homography ? options.planarPairWeight : 1
      // Twice the required angle is as good as any larger one.
      let width = min(degrees, 2 * level.angleDegrees) / level.angleDegrees
      return (certainty * width * Double(pair.matches.count), index, pair)
    }
    return scored.sorted { ($1.score, $0.index) < ($0.score, $1.index) }.map(\.pair)
  }

  /// Triangulates and adjusts one pair; nil if too few points remain.
  private func begin(
    with pair: VerifiedPair, _ level: IncrementalMapping.Options.InitialPairLevel
  ) throws -> SparseMap? {
    guard let secondFromFirst = pair.secondFromFirst else { return nil }
    var map = empty
    map.register(pair.pair.first.index, .identity)
    map.register(pair.pair.second.index, secondFromFirst)
    let tracks = map.tracks(ofPhoto: pair.pair.first.index)
    var points = PointTriangulation(
      options: .init(
        maximumError: options.initialErrorFactor * options.growthError,
        minimumAngleDegrees: options.minimumAngleDegrees))
    try points.triangulate(tracks, in: &map, control(map))
    for _ in 0..<2 where map.pointCount >= level.matches / 2 {
      try adjustment.adjustGlobally(&map, control(map))
      points.options.maximumError = options.growthError
      try points.filter(tracks, in: &map, control(map))
      try points.triangulate(tracks, in: &map, control(map))
    }
    return map.pointCount >= max(options.minimumInitialPoints, level.matches / 2) ? map : nil
  }
}

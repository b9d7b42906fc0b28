import Kernels
import SceneModel

/// Which pair to begin with, and which photo comes next.
extension MapGrowth {
  /// The photos that verified pairs connect, each group ascending, larger groups first.
  func connectedGroups() -> [[Int]] {
    var labels = Array(photos.indices)
    func label(_ photo: Int) -> Int {
      var photo = photo
      while labels[photo] != photo { photo = labels[photo] }
      return photo
    }
    for pair in graph.pairs {
      let (a, b) = (label(pair.pair.first.index), label(pair.pair.second.index))
      labels[max(a, b)] = min(a, b)
    }
    var groups = [[Int]](repeating: [], count: photos.count)
    for photo in photos.indices { groups[label(photo)].append(photo) }
    return groups.filter { !$0.isEmpty }.sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// A map of the best first pair that holds together.
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

  /// Pairs that fulfil a level, the most promising first.
  private func candidates(
    _ level: IncrementalMapping.InitialPairLevel, _ members: Set<Int>, _ isTaken: [Bool]
  ) -> [VerifiedPair] {
    let scored = graph.pairs.enumerated().compactMap {
      index, pair -> (score: Double, index: Int, pair: VerifiedPair)? in
      let ids = [pair.pair.first.index, pair.pair.second.index]
      let degrees = pair.medianAngle * 180 / .pi
      guard
        pair.secondFromFirst != nil, pair.matches.count >= level.matches,
        degrees >= level.angleDegrees, ids.allSatisfy({ members.contains($0) && !isTaken[$0] })
      else { return nil }
      // Planes and rotations leave the relative pose ambiguous.
      let certainty = pair.model == .homography ? 0.3 : 1
      let width = min(degrees, 2 * level.angleDegrees) / level.angleDegrees
      return (certainty * width * Double(pair.matches.count), index, pair)
    }
    return scored.sorted { ($1.score, $0.index) < ($0.score, $1.index) }.map(\.pair)
  }

  /// Triangulates and adjusts one pair; nil when too few points stand.
  private func begin(
    with pair: VerifiedPair, _ level: IncrementalMapping.InitialPairLevel
  ) throws -> SparseMap? {
    guard let secondFromFirst = pair.secondFromFirst else { return nil }
    var map = empty
    map.register(pair.pair.first.index, .identity)
    map.register(pair.pair.second.index, secondFromFirst)
    let tracks = map.tracks(ofPhoto: pair.pair.first.index)
    var points = PointTriangulation(
      options: .init(
        maximumError: 2 * options.growthError, minimumAngleDegrees: options.minimumAngleDegrees))
    try points.triangulate(tracks, in: &map, control(map))
    let adjustment = MapAdjustment(
      options: mapping.adjustment, initialCameras: empty.photos.cameras)
    for _ in 0..<2 where map.pointCount >= level.matches / 2 {
      try adjustment.adjustGlobally(&map, control(map))
      points.options.maximumError = options.growthError
      try points.filter(tracks, in: &map, control(map))
      try points.triangulate(tracks, in: &map, control(map))
    }
    return map.pointCount >= max(8, level.matches / 2) ? map : nil
  }

  /// The photos that see points of the map, those that see most over most of the frame first.
  func nextPhotos(_ map: SparseMap, _ isTaken: [Bool], _ failures: [Int]) -> [Int] {
    let scored = photos.indices.compactMap { photo -> (score: Int, photo: Int)? in
      guard !map.isRegistered(photo), !isTaken[photo], failures[photo] < 3 else { return nil }
      let score = visibilityScore(photo, map)
      return score > 0 ? (score, photo) : nil
    }
    return scored.sorted { ($1.score, $0.photo) < ($0.score, $1.photo) }.map(\.photo)
  }

  /// Counts occupied cells of grids of 2×2 to 32×32 over the photo, finer cells for more.
  private func visibilityScore(_ photo: Int, _ map: SparseMap) -> Int {
    let finest = 32
    let size = SIMD2(Double(photos[photo].width), Double(photos[photo].height))
    var cells = [Bool](repeating: false, count: finest * finest)
    for index in map.tracks.observationsOfPhoto[photo]
    where map.isTriangulated[Int(map.tracks.trackOfObservation[Int(index)])] {
      let place = map.tracks.pixels[Int(index)] / size * Double(finest)
      let (x, y) = (Int(min(31, max(0, place.x))), Int(min(31, max(0, place.y))))
      cells[y * finest + x] = true
    }
    var (score, side) = (0, finest)
    while side >= 2 {
      score += side * side * cells.count { $0 }
      var coarser = [Bool](repeating: false, count: side * side / 4)
      for index in cells.indices where cells[index] {
        coarser[(index / side / 2) * (side / 2) + (index % side) / 2] = true
      }
      (cells, side) = (coarser, side / 2)
    }
    return score
  }
}

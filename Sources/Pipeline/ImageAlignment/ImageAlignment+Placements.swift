import SceneModel

/// Joining photos between which the object was moved.
extension ImageAlignment {
  /// Aligns photos by the object that their masks leave. `whole` has the matches of the whole
  /// photos: photos of one placement are linked by the surroundings as well. `upright` has the
  /// poses of one placement's photos in a frame whose +y is up.
  func run(
    masked ingested: IngestedPhotos, images: ImageStore, whole: MatchedPhotos,
    placements: [[Int]], upright: [RigidTransform?], _ context: StageContext
  ) throws -> Reconstruction {
    var alignment = self
    // Two photos without masks would match the surroundings.
    alignment.options.correspondences.matchesUnmaskedPairs = false
    alignment.options.correspondences.secondMotions.isEnabled = false
    let object = try alignment.match(
      photos: ingested.photos, cameras: whole.cameras, images: images,
      context.part(from: 0, to: 0.7))
    var matched = object.adding(whole, within: placements)
    matched.graph.isObjectOnly = whole.graph.isObjectOnly
    let map = try alignment.map(matched, images: images, context.part(from: 0.7, to: 0.87))
    try alignment.throwOrWarn(map, context.notes)
    return try alignment.finish(
      map.reconstruction, matched, images, upright: upright, context.part(from: 0.87, to: 1)
    ) { point in
      let features = point.track.filter { $0.feature >= 0 }
      let own = features.count { Int($0.feature) < object.features[$0.photo.index].count }
      return 2 * own > features.count
    }
  }
}

extension ImageAlignment.MatchedPhotos {
  /// The photos with the matches of other features as well, between photos of the same group.
  fileprivate func adding(_ other: Self, within groups: [[Int]]) -> Self {
    var result = self
    let offsets = features.map { Int32($0.count) }
    for (index, set) in other.features.enumerated() { result.features[index].append(set) }
    var groupOf = [Int?](repeating: nil, count: photos.count)
    for (number, group) in groups.enumerated() { for photo in group { groupOf[photo] = number } }
    var known = Dictionary(uniqueKeysWithValues: graph.pairs.map { ($0.pair, $0) })
    for var pair in other.graph.pairs {
      let (first, second) = (pair.pair.first.index, pair.pair.second.index)
      guard let group = groupOf[first], group == groupOf[second] else { continue }
      pair.matches = pair.matches.map {
        FeatureMatch(first: $0.first + offsets[first], second: $0.second + offsets[second])
      }
      if let own = known[pair.pair] { pair.matches = own.matches + pair.matches }
      known[pair.pair] = pair
    }
    result.graph.pairs = known.values.sorted { $0.pair < $1.pair }
    return result
  }
}

extension FeatureSet {
  /// Appends other features of the same photo.
  fileprivate mutating func append(_ other: FeatureSet) {
    positions += other.positions
    scales += other.scales
    orientations += other.orientations
    descriptors += other.descriptors
    colors += other.colors
  }
}

import SceneModel

/// Recognizes matches between different instances of a repeated structure that a map has resolved.
///
/// Two points that one photo shows at once are different points, however similar they look (the
/// uniqueness constraint; Zach et al., "Disambiguating visual relations using loop constraints",
/// CVPR 2010). If a pair of photos matches such points with each other, it matches one instance of
/// a pattern with another: it contradicts neither the map nor that the scene is rigid. Of an object
/// that was moved, no photo shows two placements at once.
struct RepeatedStructure {
  /// Minimum share of a pair's matches of different points that must be of instances that one photo
  /// shows at once. Chosen: of points that are one and the same in the world it is zero, up to
  /// wrong tracks; of instances it falls short of one because features are missed.
  private static let minimumShare = 0.2
  /// Minimum number of matches of different points, as for the weakest pairs that are verified.
  private static let minimumMatches = 12
  /// Maximum number of matches of a pair that are examined.
  private static let maximumMatches = 200
  /// Distance from where the map predicts an instance, within which its feature must be, as a share
  /// of the photo's longer side.
  private static let tolerance = 0.01

  /// The point of each feature, by photo; −1 without one.
  let pointOfFeature: [[Int32]]
  private let reconstruction: Reconstruction
  private let features: [FeatureSet]
  /// The photos that observe each point, in ascending order.
  private let photosOfPoint: [[Int32]]

  init(_ reconstruction: Reconstruction, features: [FeatureSet]) {
    (self.reconstruction, self.features) = (reconstruction, features)
    var points = features.map { [Int32](repeating: -1, count: $0.count) }
    for (number, point) in reconstruction.points.enumerated() {
      for observation in point.track where observation.feature >= 0 {
        points[observation.photo.index][Int(observation.feature)] = Int32(number)
      }
    }
    pointOfFeature = points
    photosOfPoint = reconstruction.points.map { point in
      point.track.map { Int32($0.photo.index) }.sorted()
    }
  }

  /// Whether the matches of a pair are mostly between different instances of a structure.
  func explains(_ matches: [FeatureMatch], of pair: PhotoPair) -> Bool {
    let stride = max(1, matches.count / Self.maximumMatches)
    let different = Swift.stride(from: 0, to: matches.count, by: stride).map { matches[$0] }
      .filter { match in
        let (first, second) = points(match, pair)
        return first >= 0 && second >= 0 && first != second
      }
    guard different.count >= Self.minimumMatches else { return false }
    let distance = different.map { features.distance(of: $0, in: pair) }.max() ?? 0
    let grids = (grid(pair.first), grid(pair.second))
    let instances = different.count { match in
      let (first, second) = points(match, pair)
      return areSimultaneous(Int(first), Int(second))
        || shows(pair.first, Int(second), as: Int(match.first), grids.0, within: distance)
        || shows(pair.second, Int(first), as: Int(match.second), grids.1, within: distance)
    }
    return Double(instances) >= Self.minimumShare * Double(different.count)
  }

  private func points(_ match: FeatureMatch, _ pair: PhotoPair) -> (Int32, Int32) {
    (
      pointOfFeature[pair.first.index][Int(match.first)],
      pointOfFeature[pair.second.index][Int(match.second)]
    )
  }

  /// Whether one photo observes both points.
  private func areSimultaneous(_ a: Int, _ b: Int) -> Bool {
    let (first, second) = (photosOfPoint[a], photosOfPoint[b])
    var (i, j) = (0, 0)
    while i < first.count, j < second.count {
      if first[i] == second[j] { return true }
      if first[i] < second[j] { i += 1 } else { j += 1 }
    }
    return false
  }

  // MARK: Instances in a photo

  /// The features of a photo, by cell of a grid.
  private func grid(_ photo: ID<Photo>) -> FeatureGrid? {
    guard reconstruction.photos.indices.contains(photo.index),
      reconstruction.poses[photo.index] != nil
    else { return nil }
    let camera = reconstruction.camera(of: photo)
    return FeatureGrid(
      features[photo.index].positions, width: camera.width, height: camera.height,
      reach: Self.tolerance * camera.longerSide)
  }

  /// Whether a photo shows, where the map predicts a point, and not where one of its features is,
  /// the same as that feature: another feature whose descriptor is at most `limit` from its own.
  private func shows(
    _ photo: ID<Photo>, _ point: Int, as feature: Int, _ grid: FeatureGrid?, within limit: Int
  ) -> Bool {
    let set = features[photo.index]
    guard let grid, let pose = reconstruction.poses[photo.index], set.hasDescriptor(feature) else {
      return false
    }
    let seen = pose * reconstruction.points[point].position
    guard seen.z > 0 else { return false }
    let pixel = reconstruction.camera(of: photo).project(seen)
    guard (pixel - SIMD2<Double>(set.positions[feature])).length > 2 * grid.reach else {
      return false
    }
    return grid.features(near: pixel).contains { other in
      set.hasDescriptor(other) && set.distance(feature, other, of: set) <= limit
    }
  }
}

extension FeatureSet {
  /// Whether the descriptor of a feature is kept.
  fileprivate func hasDescriptor(_ feature: Int) -> Bool {
    (feature + 1) * Self.descriptorLength <= descriptors.count
  }

  /// The squared distance between the descriptors of a feature and of one of another photo.
  fileprivate func distance(_ feature: Int, _ other: Int, of set: FeatureSet) -> Int {
    guard hasDescriptor(feature), set.hasDescriptor(other) else { return 0 }
    let (first, second) = (feature * Self.descriptorLength, other * Self.descriptorLength)
    return (0..<Self.descriptorLength).reduce(0) { sum, index in
      let offset = Int(descriptors[first + index]) - Int(set.descriptors[second + index])
      return sum + offset * offset
    }
  }
}

extension [FeatureSet] {
  /// The squared distance between the descriptors of a match; 0 if they are not kept.
  fileprivate func distance(of match: FeatureMatch, in pair: PhotoPair) -> Int {
    self[pair.first.index].distance(
      Int(match.first), Int(match.second), of: self[pair.second.index])
  }
}

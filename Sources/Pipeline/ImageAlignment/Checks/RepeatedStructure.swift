import SceneModel

/// Recognizes matches between different instances of a repeated structure that a map has resolved.
///
/// Two points that one photo shows at once are different points, however similar they look (the
/// uniqueness constraint; Zach et al., "Disambiguating visual relations using loop constraints",
/// CVPR 2010). If a pair of photos matches such points with each other, it matches one instance of
/// a pattern with another: it contradicts neither the map nor that the scene is rigid. Of an object
/// that was moved, no photo shows two placements at once.
///
/// Only tracks prove that. That a photo shows the same texture where the map predicts the other
/// point does not: in a folded map of a facade, it shows another bay there.
struct RepeatedStructure {
  /// Minimum share of a pair's matches of different points that must be of points that one photo
  /// shows at once. Chosen: of points that are one and the same in the world it is zero, up to
  /// wrong tracks; of instances it falls short of one because tracks are incomplete.
  private static let minimumShare = 0.2
  /// Minimum number of matches of different points: fewer may agree by chance.
  private static let minimumMatches = PairVerification.Options().weakMinimumInliers

  /// The point of each feature, by photo; −1 without one.
  let pointOfFeature: [[Int32]]
  /// The photos that observe each point, in ascending order.
  private let photosOfPoint: [[Int32]]

  init(_ reconstruction: Reconstruction, features: [FeatureSet]) {
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
    var (different, simultaneous) = (0, 0)
    for match in matches {
      let first = pointOfFeature[pair.first.index][Int(match.first)]
      let second = pointOfFeature[pair.second.index][Int(match.second)]
      guard first >= 0, second >= 0, first != second else { continue }
      different += 1
      if areSimultaneous(Int(first), Int(second)) { simultaneous += 1 }
    }
    return different >= Self.minimumMatches
      && Double(simultaneous) >= Self.minimumShare * Double(different)
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
}

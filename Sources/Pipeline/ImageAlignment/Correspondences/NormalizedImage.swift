import SceneModel

extension Camera {
  /// The keypoints of a photo of this camera in normalized image coordinates: on their viewing rays
  /// at depth 1, without distortion.
  func normalizedPositions(of features: FeatureSet) -> [SIMD2<Double>] {
    features.positions.map { unproject(SIMD2<Double>($0)) }
  }

  /// The same for the keypoints of some matches; `feature` selects the match's keypoint in the
  /// photo.
  func normalizedPositions(
    of matches: [FeatureMatch], in features: FeatureSet, _ feature: KeyPath<FeatureMatch, Int32>
  ) -> [SIMD2<Double>] {
    matches.map { unproject(SIMD2<Double>(features.positions[Int($0[keyPath: feature])])) }
  }

  /// The photo's longer side in normalized image coordinates. Multiplied by it, a fraction of that
  /// side becomes a distance at depth 1.
  var normalizedSide: Double {
    longerSide * 2 / (focalLength.x + focalLength.y)
  }
}

extension VerifiedPair {
  /// The matches, or every n-th of them if there are twice as many as `maximumCount` or more.
  func thinnedMatches(_ maximumCount: Int) -> [FeatureMatch] {
    let step = max(1, matches.count / maximumCount)
    return stride(from: 0, to: matches.count, by: step).map { matches[$0] }
  }
}

extension ViewGraph {
  /// The pairs for which `isIncluded` is true, those with the most matches first.
  func strongestPairs(where isIncluded: (VerifiedPair) -> Bool = { _ in true }) -> [VerifiedPair] {
    pairs.filter(isIncluded).sorted { ($0.matches.count, $1.pair) > ($1.matches.count, $0.pair) }
  }
}

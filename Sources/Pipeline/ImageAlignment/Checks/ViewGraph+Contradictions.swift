import SceneModel

extension ViewGraph {
  /// Pairs whose matches don't show the same points in a reconstruction, sorted.
  ///
  /// If a scene has repeated structure, some pairs match the wrong parts and others the correct
  /// ones, and no reconstruction agrees with all of them. Pairs that match instances that the
  /// reconstruction distinguishes don't count.
  func contradicted(
    by reconstruction: Reconstruction, features: [FeatureSet],
    _ options: SceneAmbiguityCheck.Options = SceneAmbiguityCheck.Options()
  ) -> [PhotoPair] {
    contradicted(
      by: reconstruction, features: features,
      RepeatedStructure(reconstruction, features: features), options)
  }

  /// The same, with the points of the features at hand.
  func contradicted(
    by reconstruction: Reconstruction, features: [FeatureSet], _ repetition: RepeatedStructure,
    _ options: SceneAmbiguityCheck.Options
  ) -> [PhotoPair] {
    let pointOf = repetition.pointOfFeature
    /// Whether a point projects to a feature; nil without a point.
    func agrees(_ point: Int32, _ photo: ID<Photo>, _ feature: Int32) -> Bool? {
      guard point >= 0, let pose = reconstruction.poses[photo.index] else { return nil }
      let seen = pose * reconstruction.points[Int(point)].position
      guard seen.z > 0 else { return false }
      let camera = reconstruction.camera(of: photo)
      let position = SIMD2<Double>(features[photo.index].positions[Int(feature)])
      let limit = options.contradictionTolerance * camera.longerSide
      return (camera.project(seen) - position).length <= limit
    }
    return pairs.filter { pair in
      let (first, second) = (pair.pair.first, pair.pair.second)
      guard reconstruction.poses[first.index] != nil, reconstruction.poses[second.index] != nil
      else { return false }
      let verdicts = pair.matches.compactMap { match in
        agrees(pointOf[first.index][Int(match.first)], second, match.second)
          ?? agrees(pointOf[second.index][Int(match.second)], first, match.first)
      }
      let good = verdicts.count { $0 }
      return verdicts.count >= options.minimumPairMatches
        && Double(good) < options.maximumAgreement * Double(verdicts.count)
        && !repetition.explains(pair.matches, of: pair.pair)
    }.map(\.pair)
  }
}

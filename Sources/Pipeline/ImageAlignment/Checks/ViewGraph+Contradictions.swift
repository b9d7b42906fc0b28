import SceneModel

extension ViewGraph {
  /// Pairs whose matches don't show the same points in a reconstruction, sorted.
  ///
  /// If a scene has repeated structure, some pairs match the wrong parts and others the correct
  /// ones, and no reconstruction agrees with all of them. Two kinds of pairs don't count: those
  /// that match instances that the reconstruction distinguishes, and those that are far weaker than
  /// the chain of pairs that places their photos relative to each other. A map follows its strong
  /// pairs: the correct pairs that contradict a folded map are about as strong as the wrong ones
  /// that folded it.
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
    let agreements = agreements(with: reconstruction, features: features, repetition, options)
    let chains = StrongestChains(
      photoCount: reconstruction.photos.count,
      links: agreements.filter { $0.agreeing > 0 }.map {
        ($0.agreeing, $0.pair.first.index, $0.pair.second.index)
      })
    return agreements.filter { agreement in
      let pair = agreement.pair
      let chain = chains.weakestLink(between: pair.first.index, and: pair.second.index)
      return agreement.contradicts(options)
        && Double(agreement.compared) >= options.minimumContradictionStrength * Double(chain)
        && !repetition.explains(pairs[agreement.index].matches, of: pair)
    }.map(\.pair)
  }

  /// How many matches of a pair agree with a reconstruction.
  private struct Agreement {
    var index: Int
    var pair: PhotoPair
    /// Number of matches that have a point, and of those whose point projects to both features.
    var compared: Int
    var agreeing: Int

    func contradicts(_ options: SceneAmbiguityCheck.Options) -> Bool {
      compared >= options.minimumPairMatches
        && Double(agreeing) < options.maximumAgreement * Double(compared)
    }
  }

  /// The agreement of each pair whose photos are registered.
  private func agreements(
    with reconstruction: Reconstruction, features: [FeatureSet], _ repetition: RepeatedStructure,
    _ options: SceneAmbiguityCheck.Options
  ) -> [Agreement] {
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
    return pairs.indices.compactMap { index in
      let (first, second) = (pairs[index].pair.first, pairs[index].pair.second)
      guard reconstruction.poses[first.index] != nil, reconstruction.poses[second.index] != nil
      else { return nil }
      let verdicts = pairs[index].matches.compactMap { match in
        agrees(pointOf[first.index][Int(match.first)], second, match.second)
          ?? agrees(pointOf[second.index][Int(match.second)], first, match.first)
      }
      return Agreement(
        index: index, pair: pairs[index].pair, compared: verdicts.count,
        agreeing: verdicts.count { $0 })
    }
  }
}

import Kernels
import SceneModel

extension PairSelection {
  /// Selects pairs of a sequence that is short enough for preemptive matching of all pairs: the
  /// nearest neighbors in the order of capture, and for each photo those that share the most
  /// large-scale features. The latter are more distant neighbors, and photos from another time at
  /// which the path returns to the same place (loop closures).
  func sequence(
    _ photos: [Int], _ features: [FeatureSet], _ context: StageContext
  ) throws -> Candidates {
    let guaranteed = neighbors(photos, options.preemptiveSequenceSteps)
    let others = photos.indices
      .flatMap { i in photos[(i + 1)...].map { pair(photos[i], $0) } }
      .filter { !guaranteed.contains($0) }
    let counts = try PreemptiveMatching(options.preemptiveMatching).counts(
      others, features: features, context)
    let mostSimilar = ranked(others, counts, features)
    let likely = retrieved(mostSimilar, options.sequencePartners, excluding: guaranteed)
    let matched = guaranteed.union(likely)
    return Candidates(
      guaranteed: matched.sorted(), tested: [],
      untested: neighbors(photos, options.sequenceSteps).subtracting(matched).sorted(),
      mostSimilar: mostSimilar, ordering: .sequential)
  }

  /// For each photo the others that share enough large-scale features, the most matches first.
  private func ranked(
    _ pairs: [PhotoPair], _ counts: [Int], _ features: [FeatureSet]
  ) -> [[Int]] {
    let fewFeatures =
      options.preemptiveMatching.minimumFeatureFactor * options.preemptiveMatching.features
    var mostSimilar = [[(photo: Int, matches: Int)]](repeating: [], count: features.count)
    for (pair, matches) in zip(pairs, counts) {
      let (first, second) = (pair.first.index, pair.second.index)
      // Photos with few features share few, and full matching is fast.
      let hasFew = min(features[first].count, features[second].count) < fewFeatures
      guard matches >= (hasFew ? 1 : options.sequenceMatches) else { continue }
      mostSimilar[first].append((second, matches))
      mostSimilar[second].append((first, matches))
    }
    return mostSimilar.map {
      $0.sorted { ($1.matches, $0.photo) < ($0.matches, $1.photo) }.map(\.photo)
    }
  }
}

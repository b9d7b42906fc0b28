import Kernels
import SceneModel

extension PairSelection {
  /// Selects pairs of a sequence that is short enough for preemptive matching of all pairs: the
  /// nearest neighbors in the order of capture, and for each photo those that share the most
  /// large-scale features. The latter are more distant neighbors, and photos from another time at
  /// which the path returns to the same place (loop closures).
  func sequence(
    _ photos: [Int], _ features: [FeatureSet], _ context: StageContext
  ) throws -> Choice {
    let sure = neighbours(photos, options.lookedSequenceSteps)
    let others = photos.indices
      .flatMap { i in photos[(i + 1)...].map { pair(photos[i], $0) } }
      .filter { !sure.contains($0) }
    let counts = try FirstLook(options.firstLook).counts(others, features: features, context)
    let alike = ranked(others, counts, features)
    let likely = retrieved(alike, options.sequencePartners, besides: sure)
    let window = neighbours(photos, options.sequenceSteps)
    return Choice(
      pairs: sure.union(likely).sorted(), candidates: sure.union(likely).union(window).sorted(),
      alike: alike, isSequential: true)
  }

  /// For each photo the others that share enough large-scale features, the most matches first.
  private func ranked(
    _ pairs: [PhotoPair], _ counts: [Int], _ features: [FeatureSet]
  ) -> [[Int]] {
    let fewFeatures = options.firstLook.worthwhileFactor * options.firstLook.features
    var alike = [[(photo: Int, matches: Int)]](repeating: [], count: features.count)
    for (pair, matches) in zip(pairs, counts) {
      let (first, second) = (pair.first.index, pair.second.index)
      // Photos with few features share few, and full matching is fast.
      let hasFew = min(features[first].count, features[second].count) < fewFeatures
      guard matches >= (hasFew ? 1 : options.sequenceMatches) else { continue }
      alike[first].append((second, matches))
      alike[second].append((first, matches))
    }
    return alike.map {
      $0.sorted { ($1.matches, $0.photo) < ($0.matches, $1.photo) }.map(\.photo)
    }
  }
}

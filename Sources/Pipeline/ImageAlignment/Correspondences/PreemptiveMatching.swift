import Kernels
import SceneModel

/// Preemptive matching (Wu, "Towards linear-time incremental structure from motion", 3DV 2013):
/// tests at low cost whether two photos may show the same surface, by matching only their
/// largest-scale features. These are few, and they survive a change of distance longest.
package struct PreemptiveMatching {
  package struct Options: Hashable, Codable, Sendable {
    /// Number of features per photo that are matched. Chosen.
    package var features = 1024
    /// Ratio of the ratio test; more permissive than that of full matching. Paper: Lowe 2004,
    /// section 7.1.
    package var ratio = 0.8
    /// Pairs with fewer matches are unpromising. Chosen.
    package var minimumMatches = 5
    /// Photos with fewer features than this multiple of `features` skip the test: full matching is
    /// just as fast. Chosen.
    package var minimumFeatureFactor = 2

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the promising pairs of `pairs`, in the same order.
  package func run(
    _ pairs: [PhotoPair], features: [FeatureSet], _ context: StageContext
  ) throws -> [PhotoPair] {
    var matching = DescriptorMatching()
    matching.ratio = options.ratio
    let isPromising = try context.control.parallelMap(pairs.count) { [matching, options] index in
      let first = features[pairs[index].first.index], second = features[pairs[index].second.index]
      guard min(first.count, second.count) >= options.minimumFeatureFactor * options.features else {
        return true
      }
      return try matching.matches(first, second, prefix: options.features, KernelControl()).count
        >= options.minimumMatches
    }
    return zip(pairs, isPromising).filter { $1 }.map(\.0)
  }

  /// Returns the number of matches among the largest features of each pair.
  package func counts(
    _ pairs: [PhotoPair], features: [FeatureSet], _ context: StageContext
  ) throws -> [Int] {
    var matching = DescriptorMatching()
    matching.ratio = options.ratio
    return try context.control.parallelMap(pairs.count) { [matching, options] index in
      let first = features[pairs[index].first.index], second = features[pairs[index].second.index]
      return try matching.matches(first, second, prefix: options.features, KernelControl()).count
    }
  }
}

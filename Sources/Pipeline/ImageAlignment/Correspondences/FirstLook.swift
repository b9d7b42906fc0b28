import Kernels
import SceneModel

/// Tells cheaply whether two photos may show the same surface, by matching their features of the
/// largest scale only, which are few and which a change of distance hides last.
package struct FirstLook {
  package struct Options: Hashable, Codable, Sendable {
    /// Features of each photo that are matched.
    package var features = 1024
    /// More permissive than the ratio of the matching.
    package var ratio = 0.8
    /// Pairs with fewer matches are hopeless.
    package var minimumMatches = 5
    /// Photos of fewer features than this multiple of `features` are matched as fast in full.
    package var worthwhileFactor = 2

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Those of `pairs` that aren't hopeless, in the same order.
  package func run(
    _ pairs: [PhotoPair], features: [FeatureSet], _ context: StageContext
  ) throws -> [PhotoPair] {
    var matching = DescriptorMatching()
    matching.ratio = options.ratio
    let isHopeful = try context.control.parallelMap(pairs.count) { [matching, options] index in
      let first = features[pairs[index].first.index], second = features[pairs[index].second.index]
      guard min(first.count, second.count) >= options.worthwhileFactor * options.features else {
        return true
      }
      return try matching.matches(first, second, prefix: options.features, KernelControl()).count
        >= options.minimumMatches
    }
    return zip(pairs, isHopeful).filter { $1 }.map(\.0)
  }

  /// How many of the largest features of each of `pairs` match.
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

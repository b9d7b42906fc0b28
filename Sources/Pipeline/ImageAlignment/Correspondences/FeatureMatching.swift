import Kernels
import SceneModel

/// Matches the features of pairs of photos: exact mutual nearest neighbors with Lowe's ratio test.
package struct FeatureMatching {
  package struct Options: Hashable, Codable, Sendable {
    package var matching = DescriptorMatching()

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the matches of each pair, as far as they are not among `units` already.
  func run(
    _ pairs: [PhotoPair], features: [FeatureSet], units: CorrespondenceUnits,
    _ context: StageContext
  ) throws -> [[FeatureMatch]] {
    try MatchBlock.ranges(of: pairs).flatMap { range in
      let part = context.part(
        from: Double(range.lowerBound) / Double(pairs.count),
        to: Double(range.upperBound) / Double(pairs.count))
      return try units.block(pairs[range], options) {
        MatchBlock(matches: try run(Array(pairs[range]), features: features, part))
      }.matches
    }
  }

  /// Returns the matches of each pair, the most distinctive first.
  package func run(
    _ pairs: [PhotoPair], features: [FeatureSet], _ context: StageContext
  ) throws -> [[FeatureMatch]] {
    try context.control.parallelMap(pairs.count) { [options] index in
      let pair = pairs[index]
      return try options.matching.matches(
        features[pair.first.index], features[pair.second.index], KernelControl())
    }
  }
}

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

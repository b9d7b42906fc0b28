import CKernels
import SceneModel

/// Exact nearest-neighbor matching of descriptors: mutual best, with Lowe's ratio test in both
/// directions.
package struct DescriptorMatching: Hashable, Codable, Sendable {
  /// Maximum ratio of the best to the second-best distance. Chosen: stricter than the 0.8 of Lowe
  /// 2004, section 7.1.
  package var ratio = 0.7
  /// Maximum distance of a match; a descriptor has length 512. Chosen.
  package var maximumDistance = 360.0
  /// All instruction sets give the same result.
  package var instructions = Instructions.automatic

  package init() {}

  /// The matches between two sets, most distinctive first.
  ///
  /// With `prefix`, only that many features of each set are matched: those of the largest scale.
  package func matches(
    _ first: FeatureSet, _ second: FeatureSet, prefix: Int = .max, _ control: KernelControl
  ) throws -> [FeatureMatch] {
    let counts = (min(prefix, first.count), min(prefix, second.count))
    var matches = Array(
      repeating: FeatureMatch(first: 0, second: 0), count: min(counts.0, counts.1))
    guard !matches.isEmpty else { return [] }
    var options = ck_match_options(
      ratio: ratio, maximum_distance: maximumDistance, instructions: instructions.raw)
    var count = 0
    try withKernel(control) { control in
      matches.withUnsafeMutableBytes { pairs in
        ck_match_descriptors(
          first.descriptors, counts.0, second.descriptors, counts.1, &options, control,
          pairs.baseAddress?.assumingMemoryBound(to: Int32.self), &count)
      }
    }
    matches.removeLast(matches.count - count)
    return matches
  }
}

import CKernels
import SceneModel

/// Finds features that look like another feature of the same photo: those of wallpaper, tiles, or
/// the bays of a facade.
package struct RepetitionSearch: Hashable, Codable, Sendable {
  /// Half the side of a descriptor's window, in units of the feature's scale σ; features whose
  /// windows overlap are no repetition. Paper: Lowe 2004, section 6: two bins of 3σ.
  package var windowRadius = 6.0
  /// Maximum distance of the descriptors of two features that look the same; a descriptor has
  /// length 512.
  package var maximumDistance: Double

  package init(maximumDistance: Double) { self.maximumDistance = maximumDistance }

  /// Whether each of the features with indices in `queries` is repeated among all features of the
  /// photo. Throws `KernelError` if an index is out of range.
  package func areRepeated(
    _ queries: [Int32], of features: FeatureSet, _ control: KernelControl
  ) throws -> [Bool] {
    var flags = [UInt8](repeating: 0, count: queries.count)
    var options = ck_repetition_options(
      window_radius: windowRadius, maximum_distance: maximumDistance)
    try withKernel(control) { control in
      features.positions.withUnsafeBytes { positions in
        ck_find_repeated_features(
          features.descriptors, positions.baseAddress?.assumingMemoryBound(to: Float.self),
          features.scales, features.count, queries, queries.count, &options, control, &flags)
      }
    }
    return flags.map { $0 != 0 }
  }
}

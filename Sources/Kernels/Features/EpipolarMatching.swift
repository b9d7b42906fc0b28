import CKernels
import SceneModel

/// Nearest-neighbor matching of descriptors along epipolar lines: mutual best among the features
/// near the line, with Lowe's ratio test among these only.
package struct EpipolarMatching: Hashable, Codable, Sendable {
  /// The features of one photo.
  package struct Side: Sendable {
    var descriptors: [UInt8]
    /// NaN for excluded features.
    var points: [SIMD2<Double>]

    /// `points` are at depth 1 of the viewing rays, one per feature of the set; the features with
    /// indices in `taken` are excluded.
    package init(_ features: FeatureSet, points: [SIMD2<Double>], except taken: [Int32]) {
      descriptors = features.descriptors
      self.points = points
      for index in taken { self.points[Int(index)] = SIMD2(repeating: .nan) }
    }
  }

  /// Maximum Sampson error of a match in units of the points. Chosen: `PairVerification` has a
  /// limit in pixels.
  package var maximumError = 1e-3
  /// Maximum ratio of the best to the second-best distance. Chosen: as in `DescriptorMatching`.
  package var ratio = 0.7
  /// Maximum distance of a match; a descriptor has length 512. Chosen.
  package var maximumDistance = 250.0

  package init() {}

  /// The matches consistent with `matrix` (`x₂ᵀ M x₁ = 0`), most distinctive first.
  package func matches(
    _ first: Side, _ second: Side, matrix: Matrix3, _ control: KernelControl
  ) throws -> [FeatureMatch] {
    var matches = Array(
      repeating: FeatureMatch(first: 0, second: 0),
      count: min(first.points.count, second.points.count))
    guard !matches.isEmpty else { return [] }
    let m = (matrix.row0, matrix.row1, matrix.row2)
    var options = ck_guided_match_options(
      matrix: (m.0.x, m.0.y, m.0.z, m.1.x, m.1.y, m.1.z, m.2.x, m.2.y, m.2.z),
      maximum_error: maximumError, ratio: ratio, maximum_distance: maximumDistance)
    var count = 0
    try withKernel(control) { control in
      matches.withUnsafeMutableBytes { pairs in
        first.withKernelValue { first in
          second.withKernelValue { second in
            ck_match_guided(
              first, second, &options, control,
              pairs.baseAddress?.assumingMemoryBound(to: Int32.self), &count)
          }
        }
      }
    }
    matches.removeLast(matches.count - count)
    return matches
  }
}

extension EpipolarMatching.Side {
  fileprivate func withKernelValue<Result>(
    _ body: (UnsafePointer<ck_features>) -> Result
  ) -> Result {
    descriptors.withUnsafeBufferPointer { descriptors in
      withCoordinates(points) { points in
        var value = ck_features(
          descriptors: descriptors.baseAddress, points: points.baseAddress,
          count: self.points.count)
        return body(&value)
      }
    }
  }
}

import Foundation
import SceneModel

/// Estimates the scale, rotation and translation that align points with their counterparts.
///
/// Adds a robust variant to the least-squares fit of `SimilarityTransform.fitting`.
package struct SimilarityAlignment: Sendable {
  package struct Options: Codable, Hashable, Sendable {
    /// Number of samples of the robust variant. Chosen.
    package var trials = 400
    /// Inlier threshold as a fraction of the targets' mean distance from their centroid. Chosen.
    package var inlierFraction = 0.02
    /// Number of pairs in a sample; a consensus set must have at least as many. Chosen.
    package var sampleSize = 4
    /// Maximum number of fits to the growing consensus set. Chosen.
    package var refinements = 3

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The similarity with the least sum of squared distances; nil for fewer than three pairs and for
  /// collinear points, which determine no rotation.
  package func leastSquares(
    from source: [SIMD3<Double>], to target: [SIMD3<Double>]
  ) -> SimilarityTransform? {
    let count = min(source.count, target.count)
    return .fitting(
      Array(source.prefix(count)), to: Array(target.prefix(count)), requiresUniqueRotation: true)
  }

  /// The least-squares similarity of the largest consensus set (RANSAC), which tolerates a few
  /// outliers.
  package func robust(
    from source: [SIMD3<Double>], to target: [SIMD3<Double>]
  ) -> SimilarityTransform? {
    let count = min(source.count, target.count)
    let center = Self.mean(target)
    let spread = target.reduce(0) { $0 + ($1 - center).length } / Double(max(1, count))
    let limit = options.inlierFraction * spread
    func inliers(of transform: SimilarityTransform) -> [Int] {
      (0..<count).filter { (transform * source[$0] - target[$0]).length <= limit }
    }
    func fit(_ indices: [Int]) -> SimilarityTransform? {
      leastSquares(from: indices.map { source[$0] }, to: indices.map { target[$0] })
    }
    var best: [Int] = []
    var random = SplitMix64(seed: UInt64(count))
    for _ in 0..<(count > options.sampleSize ? options.trials : 0) {
      let sample = random.distinct(options.sampleSize, below: count)
      guard let transform = fit(sample) else { continue }
      let agreeing = inliers(of: transform)
      if agreeing.count > best.count { best = agreeing }
      if best.count == count { break }
    }
    for _ in 0..<options.refinements {
      guard best.count >= options.sampleSize, let transform = fit(best) else { break }
      let agreeing = inliers(of: transform)
      guard agreeing.count >= best.count, agreeing != best else { break }
      best = agreeing
    }
    return (best.count >= options.sampleSize ? fit(best) : nil)
      ?? leastSquares(from: source, to: target)
  }

  private static func mean(_ points: [SIMD3<Double>]) -> SIMD3<Double> {
    points.reduce(.zero, +) / Double(max(1, points.count))
  }
}

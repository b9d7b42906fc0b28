import Foundation
import SceneModel

/// Estimates the scale, rotation and translation that align points with their counterparts.
///
/// The least-squares similarity of Umeyama (PAMI 1991), with the rotation from Horn's unit
/// quaternion method (JOSA A 1987), which never yields a reflection.
package struct SimilarityAlignment: Sendable {
  package struct Options: Codable, Hashable, Sendable {
    /// Number of samples of the robust variant.
    package var trials = 400
    /// Inlier threshold as a fraction of the targets' mean distance from their centroid.
    package var inlierFraction = 0.02

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
    guard count >= 3 else { return nil }
    let (sourceCenter, targetCenter) = (Self.mean(source), Self.mean(target))
    var covariance = [SIMD3<Double>](repeating: .zero, count: 3)
    var variance = 0.0
    for index in 0..<count {
      let (a, b) = (source[index] - sourceCenter, target[index] - targetCenter)
      for axis in 0..<3 { covariance[axis] += a[axis] * b }
      variance += a.squaredLength
    }
    guard variance > 0, let rotation = Self.rotation(covariance) else { return nil }
    var scale = 0.0
    for index in 0..<count {
      scale += (target[index] - targetCenter).dot(rotation * (source[index] - sourceCenter))
    }
    scale /= variance
    guard scale.isFinite, scale > 0 else { return nil }
    return SimilarityTransform(
      scale: scale, rotation: rotation,
      translation: targetCenter - scale * (rotation * sourceCenter))
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
    for _ in 0..<(count > 4 ? options.trials : 0) {
      let sample = random.distinct(4, below: count)
      guard let transform = fit(sample) else { continue }
      let agreeing = inliers(of: transform)
      if agreeing.count > best.count { best = agreeing }
      if best.count == count { break }
    }
    for _ in 0..<3 {
      guard best.count >= 4, let transform = fit(best) else { break }
      let agreeing = inliers(of: transform)
      guard agreeing.count >= best.count, agreeing != best else { break }
      best = agreeing
    }
    return (best.count >= 4 ? fit(best) : nil) ?? leastSquares(from: source, to: target)
  }

  private static func mean(_ points: [SIMD3<Double>]) -> SIMD3<Double> {
    points.reduce(.zero, +) / Double(max(1, points.count))
  }

  /// The rotation that maximizes Σ b · R a for `covariance[i] = Σ aᵢ b`; nil if it is not unique.
  private static func rotation(_ s: [SIMD3<Double>]) -> Quaternion? {
    let (trace, x, y, z) = (
      s[0].x + s[1].y + s[2].z, s[1].z - s[2].y, s[2].x - s[0].z, s[0].y - s[1].x
    )
    let matrix: [[Double]] = [
      [trace, x, y, z],
      [x, s[0].x - s[1].y - s[2].z, s[0].y + s[1].x, s[2].x + s[0].z],
      [y, s[0].y + s[1].x, s[1].y - s[0].x - s[2].z, s[1].z + s[2].y],
      [z, s[2].x + s[0].z, s[1].z + s[2].y, s[2].z - s[0].x - s[1].y],
    ]
    let eigen = SymmetricEigen(matrix)
    let order = eigen.values.indices.sorted { eigen.values[$0] > eigen.values[$1] }
    let scale = eigen.values.reduce(0) { max($0, abs($1)) }
    guard scale > 0, eigen.values[order[0]] - eigen.values[order[1]] > 1e-9 * scale else {
      return nil
    }
    let q = eigen.vectors[order[0]]
    return Quaternion(x: q[1], y: q[2], z: q[3], w: q[0]).normalized
  }
}

import Foundation
import SceneModel

/// Errors of estimated poses after alignment with the best similarity.
///
/// The rotation between the two worlds is the mean over the cameras, so that collinear cameras are
/// supported, too.
package struct PoseComparison: Sendable {
  /// Maximum distance between camera centers in units of the true world.
  package var maximumCenterError = 0.0
  /// Maximum angle between rotations in radians.
  package var maximumRotationError = 0.0
  /// Number of photos with a pose.
  package var count: Int
  package var trueFromEstimated = SimilarityTransform.identity

  /// Compares the photos that have a pose in `estimated`; the errors are infinite for fewer than
  /// two.
  package init(estimated: [RigidTransform?], true truth: [RigidTransform]) {
    let pairs = zip(estimated, truth).compactMap { estimate, truth in
      estimate.map { (estimate: $0, truth: truth) }
    }
    count = pairs.count
    guard pairs.count >= 2 else {
      (maximumCenterError, maximumRotationError) = (.infinity, .infinity)
      return
    }
    trueFromEstimated = Self.similarity(pairs)
    for (estimate, truth) in pairs {
      let moved = trueFromEstimated * estimate.center
      maximumCenterError = max(maximumCenterError, (moved - truth.center).length)
      let rotation = estimate.rotation * trueFromEstimated.rotation.conjugate
      maximumRotationError = max(
        maximumRotationError, (rotation * truth.rotation.conjugate).angle)
    }
  }

  private static func similarity(
    _ pairs: [(estimate: RigidTransform, truth: RigidTransform)]
  ) -> SimilarityTransform {
    var sum = SIMD4<Double>.zero
    for (estimate, truth) in pairs {
      let q = truth.rotation.conjugate * estimate.rotation
      let v = SIMD4(q.x, q.y, q.z, q.w)
      sum += (sum * v).sum() < 0 ? -v : v
    }
    let rotation = Quaternion(x: sum.x, y: sum.y, z: sum.z, w: sum.w).normalized
    let count = Double(pairs.count)
    let mean = pairs.reduce(.zero) { $0 + rotation * $1.estimate.center } / count
    let trueMean = pairs.reduce(.zero) { $0 + $1.truth.center } / count
    var (projected, spread) = (0.0, 0.0)
    for (estimate, truth) in pairs {
      let p = rotation * estimate.center - mean
      projected += p.dot(truth.center - trueMean)
      spread += p.squaredLength
    }
    let scale = projected / spread
    return SimilarityTransform(
      scale: scale, rotation: rotation, translation: trueMean - scale * mean)
  }
}

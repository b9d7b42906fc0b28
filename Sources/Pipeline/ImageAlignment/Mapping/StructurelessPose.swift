import Foundation
import SceneModel

/// Estimates the pose of a photo from its pairs with registered photos only, for photos that
/// observe too few points of the map: the rotations implied by the pairs are averaged, and the
/// center is the intersection of the directions from the other photos (in the spirit of Zheng and
/// Wu, "Structure from motion using structure-less resection", ICCV 2015).
struct StructurelessPose: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum number of matches of a pair. Chosen.
    var minimumMatches = 30
    /// Minimum median triangulation angle of a pair in degrees. Chosen.
    var minimumAngleDegrees = 2.0
    /// Minimum number of agreeing pairs. Limit: one pair gives a direction, two a position.
    var minimumPairs = 2
    /// Maximum angle in degrees between a pair's rotation or direction and the pose. Chosen.
    var maximumErrorDegrees = 5.0
    /// Minimum angle in degrees at which two directions must intersect. Chosen.
    var minimumIntersectionDegrees = 10.0
  }

  var options = Options()

  /// The constraint from one pair with a registered photo.
  private struct PairConstraint {
    /// `photoFromWorld` rotation of the photo to be registered.
    var rotation: Quaternion
    /// The other photo's center, and the unit direction from it, in the world frame.
    var origin: SIMD3<Double>
    var direction: SIMD3<Double>
  }

  /// Returns `cameraFromWorld` of `photo`; nil if too few of its verified pairs agree.
  func run(
    _ photo: Int, pairs: [VerifiedPair], poses: [RigidTransform?]
  ) -> RigidTransform? {
    let constraints = pairs.compactMap { constraint(photo, $0, poses) }
    guard let agreeing = largestAgreement(constraints.map(\.rotation)),
      agreeing.count >= options.minimumPairs
    else { return nil }
    let rotation = mean(agreeing.map { constraints[$0].rotation })
    guard let center = robustIntersection(agreeing.map { constraints[$0] }) else { return nil }
    return RigidTransform(rotation: rotation, translation: -(rotation * center))
  }

  private func constraint(_ photo: Int, _ pair: VerifiedPair, _ poses: [RigidTransform?])
    -> PairConstraint?
  {
    let isFirst = pair.pair.first.index == photo
    guard isFirst || pair.pair.second.index == photo,
      pair.matches.count >= options.minimumMatches,
      pair.medianAngle >= options.minimumAngleDegrees * .pi / 180,
      let secondFromFirst = pair.secondFromFirst,
      let other = poses[isFirst ? pair.pair.second.index : pair.pair.first.index]
    else { return nil }
    let photoFromOther = isFirst ? secondFromFirst.inverse : secondFromFirst
    return PairConstraint(
      rotation: (photoFromOther.rotation * other.rotation).normalized, origin: other.center,
      direction: (other.rotation.conjugate * photoFromOther.center).normalized)
  }

  /// The indices of the largest set of rotations within the error limit of one of them.
  private func largestAgreement(_ rotations: [Quaternion]) -> [Int]? {
    let limit = options.maximumErrorDegrees * .pi / 180
    return rotations.map { center in
      rotations.indices.filter { (rotations[$0] * center.conjugate).angle <= limit }
    }.max { $0.count < $1.count }
  }

  /// The mean of rotations that are close to each other.
  private func mean(_ rotations: [Quaternion]) -> Quaternion {
    let all = rotations.map { SIMD4($0.x, $0.y, $0.z, $0.w) }
    // A quaternion and its negative represent the same rotation.
    let sum = all.reduce(SIMD4<Double>.zero) { $0 + (($1 * all[0]).sum() < 0 ? -$1 : $1) }
    return Quaternion(x: sum.x, y: sum.y, z: sum.z, w: sum.w).normalized
  }

  /// The robust intersection of the directions: the best intersection of two, then of all that
  /// agree with it.
  private func robustIntersection(_ constraints: [PairConstraint]) -> SIMD3<Double>? {
    var best: [PairConstraint] = []
    for first in constraints.indices {
      for second in constraints.indices where second > first {
        guard let point = intersection([constraints[first], constraints[second]]) else { continue }
        let agreeing = constraints.filter { isConsistent(point, $0) }
        if agreeing.count > best.count { best = agreeing }
      }
    }
    guard best.count >= options.minimumPairs, let point = intersection(best),
      best.allSatisfy({ isConsistent(point, $0) })
    else { return nil }
    return point
  }

  private func isConsistent(_ point: SIMD3<Double>, _ constraint: PairConstraint) -> Bool {
    (point - constraint.origin).normalized.dot(constraint.direction)
      >= cos(options.maximumErrorDegrees * .pi / 180)
  }

  /// The point closest to all lines in the least-squares sense; nil if they are nearly parallel.
  private func intersection(_ constraints: [PairConstraint]) -> SIMD3<Double>? {
    let cosines = constraints.map { abs($0.direction.dot(constraints[0].direction)) }
    guard (cosines.min() ?? 1) < cos(options.minimumIntersectionDegrees * .pi / 180) else {
      return nil
    }
    // Σ (I − d dᵀ) x = Σ (I − d dᵀ) o
    var rows = [SIMD3<Double>](repeating: .zero, count: 3)
    var right = SIMD3<Double>.zero
    for constraint in constraints {
      let d = constraint.direction
      for row in 0..<3 {
        var unit = SIMD3<Double>.zero
        unit[row] = 1
        rows[row] += unit - d[row] * d
      }
      right += constraint.origin - d.dot(constraint.origin) * d
    }
    let determinant = rows[0].dot(rows[1].cross(rows[2]))
    guard abs(determinant) > 1e-12 else { return nil }
    // The matrix is symmetric: its rows are its columns.
    return SIMD3(
      right.dot(rows[1].cross(rows[2])), right.dot(rows[2].cross(rows[0])),
      right.dot(rows[0].cross(rows[1]))) / determinant
  }
}

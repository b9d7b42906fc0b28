import Foundation

extension SimilarityTransform {
  /// Minimum relative gap between the two largest eigenvalues for the rotation to be unique.
  /// Chosen.
  private static let minimumGap = 1e-9

  /// The similarity that maps `source` to `target` with the least sum of squared distances.
  ///
  /// Rotation by Horn's unit quaternion method (JOSA A 1987), which never yields a reflection,
  /// scale by the formula of Umeyama (PAMI 1991). Nil with fewer than three pairs or if all points
  /// coincide; with `requiresUniqueRotation`, also for collinear points, which determine no
  /// rotation.
  package static func fitting(
    _ source: [SIMD3<Double>], to target: [SIMD3<Double>], requiresUniqueRotation: Bool = false
  ) -> SimilarityTransform? {
    guard source.count == target.count, source.count >= 3 else { return nil }
    let count = Double(source.count)
    let sourceMean = source.reduce(.zero, +) / count
    let targetMean = target.reduce(.zero, +) / count
    var rows = [SIMD3<Double>](repeating: .zero, count: 3)
    var spread = 0.0
    for (a, b) in zip(source, target) {
      let (p, q) = (a - sourceMean, b - targetMean)
      for axis in 0..<3 { rows[axis] += p[axis] * q }
      spread += p.squaredLength
    }
    guard spread > 0, spread.isFinite else { return nil }
    let (rotation, isUnique) = hornRotation(rows)
    guard isUnique || !requiresUniqueRotation else { return nil }
    var projected = 0.0
    for (a, b) in zip(source, target) {
      projected += (rotation * (a - sourceMean)).dot(b - targetMean)
    }
    let scale = projected / spread
    guard scale > 0, scale.isFinite else { return nil }
    return SimilarityTransform(
      scale: scale, rotation: rotation,
      translation: targetMean - scale * (rotation * sourceMean))
  }

  /// The rotation that maximizes Σ q·(R p) for `s[i][j] = Σ p_i q_j`, and whether it is unique.
  private static func hornRotation(
    _ s: [SIMD3<Double>]
  ) -> (rotation: Quaternion, isUnique: Bool) {
    let (xx, xy, xz) = (s[0].x, s[0].y, s[0].z)
    let (yx, yy, yz) = (s[1].x, s[1].y, s[1].z)
    let (zx, zy, zz) = (s[2].x, s[2].y, s[2].z)
    let n: [[Double]] = [
      [xx + yy + zz, yz - zy, zx - xz, xy - yx],
      [yz - zy, xx - yy - zz, xy + yx, zx + xz],
      [zx - xz, xy + yx, -xx + yy - zz, yz + zy],
      [xy - yx, zx + xz, yz + zy, -xx - yy + zz],
    ]
    let eigen = SymmetricEigen(n)
    let largest = (1..<4).reduce(0) { eigen.values[$1] > eigen.values[$0] ? $1 : $0 }
    let q = eigen.vectors[largest]
    let scale = eigen.values.reduce(0) { max($0, abs($1)) }
    let others = eigen.values.indices.filter { $0 != largest }.map { eigen.values[$0] }
    let gap = eigen.values[largest] - (others.max() ?? 0)
    let isUnique = scale > 0 && gap > minimumGap * scale
    return (Quaternion(x: q[1], y: q[2], z: q[3], w: q[0]).normalized, isUnique)
  }
}

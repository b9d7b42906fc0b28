import Foundation

extension SimilarityTransform {
  /// The similarity that maps `source` to `target` with the least sum of squared distances.
  ///
  /// Rotation by Horn's quaternion (1987), scale by Umeyama's (1991) formula. Nil with fewer than
  /// three pairs or without spread.
  package static func fitting(
    _ source: [SIMD3<Double>], to target: [SIMD3<Double>]
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
    let rotation = hornRotation(rows)
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

  /// The rotation that maximises Σ q·(R p) for `s[i][j] = Σ p_i q_j`.
  private static func hornRotation(_ s: [SIMD3<Double>]) -> Quaternion {
    let (xx, xy, xz) = (s[0].x, s[0].y, s[0].z)
    let (yx, yy, yz) = (s[1].x, s[1].y, s[1].z)
    let (zx, zy, zz) = (s[2].x, s[2].y, s[2].z)
    let n: [SIMD4<Double>] = [
      [xx + yy + zz, yz - zy, zx - xz, xy - yx],
      [yz - zy, xx - yy - zz, xy + yx, zx + xz],
      [zx - xz, xy + yx, -xx + yy - zz, yz + zy],
      [xy - yx, zx + xz, yz + zy, -xx - yy + zz],
    ]
    let q = largestEigenvector(n)
    return Quaternion(x: q.y, y: q.z, z: q.w, w: q.x).normalized
  }

  /// Jacobi's cyclic method on a symmetric 4×4 matrix.
  private static func largestEigenvector(_ matrix: [SIMD4<Double>]) -> SIMD4<Double> {
    var a = matrix
    var v: [SIMD4<Double>] = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    for _ in 0..<50 {
      var change = 0.0
      for p in 0..<3 {
        for q in (p + 1)..<4 where a[p][q] != 0 {
          change = max(change, abs(a[p][q]))
          let theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
          let t = (theta < 0 ? -1 : 1) / (abs(theta) + (theta * theta + 1).squareRoot())
          let c = 1 / (t * t + 1).squareRoot()
          let s = t * c
          for k in 0..<4 {
            (a[k][p], a[k][q]) = (c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q])
          }
          (a[p], a[q]) = (c * a[p] - s * a[q], s * a[p] + c * a[q])
          for k in 0..<4 {
            (v[k][p], v[k][q]) = (c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q])
          }
        }
      }
      if change < 1e-300 { break }
    }
    var best = 0
    for index in 1..<4 where a[index][index] > a[best][best] { best = index }
    return [v[0][best], v[1][best], v[2][best], v[3][best]]
  }
}

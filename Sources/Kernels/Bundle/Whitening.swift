/// The square root of the information matrix of an observation, an upper triangle: it turns a
/// residual into one whose components are independent and equally precise.
///
/// A feature on an edge, such as the grain of wood, is located across it only.
package struct Whitening: Hashable, Sendable {
  package var xx: Double
  package var xy: Double
  package var yy: Double

  package static let identity = Whitening(xx: 1, xy: 0, yy: 1)

  private init(xx: Double, xy: Double, yy: Double) { (self.xx, self.xy, self.yy) = (xx, xy, yy) }

  /// The inverse of the square root of a covariance (xx, xy, yy), which is positive definite, in
  /// units of `deviation`.
  package init(covariance c: SIMD3<Double>, deviation: Double) {
    let determinant = c.x * c.z - c.y * c.y
    // The Cholesky factor of the inverse, which is (c.z, −c.y, c.x) / determinant.
    let scale = deviation / determinant.squareRoot()
    xx = scale * c.z.squareRoot()
    xy = -scale * c.y / c.z.squareRoot()
    yy = deviation / c.z.squareRoot()
  }
}

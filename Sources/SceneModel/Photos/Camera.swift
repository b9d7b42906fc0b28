/// A physical camera: body, lens and zoom setting shared by several photos.
///
/// A pinhole camera with OpenCV's distortion model; zero coefficients mean no distortion. Focal
/// lengths and principal point are in pixels of the upright photo, with the origin at the top-left
/// corner of the top-left pixel.
package struct Camera: Hashable, Codable, Sendable {
  /// The source of the focal length: a guess, the photo's metadata, or alignment.
  package enum Calibration: String, Hashable, Codable, Sendable { case assumed, exif, refined }

  /// Size of the upright photo in pixels.
  package var width: Int
  package var height: Int
  /// Horizontal and vertical focal length in pixels.
  package var focalLength: SIMD2<Double>
  package var principalPoint: SIMD2<Double>
  /// OpenCV's k1, k2, p1, p2.
  package var distortion: SIMD4<Double>
  package var calibration: Calibration

  /// The principal point defaults to the image center.
  package init(
    width: Int, height: Int, focalLength: SIMD2<Double>, principalPoint: SIMD2<Double>? = nil,
    distortion: SIMD4<Double> = .zero, calibration: Calibration = .assumed
  ) {
    self.width = width
    self.height = height
    self.focalLength = focalLength
    self.principalPoint = principalPoint ?? [Double(width) / 2, Double(height) / 2]
    self.distortion = distortion
    self.calibration = calibration
  }

  /// The longer side of the photo in pixels.
  package var longerSide: Double { Double(max(width, height)) }

  /// The pixel of a point in the camera frame (x right, y down, z forward, z > 0).
  package func project(_ point: SIMD3<Double>) -> SIMD2<Double> {
    distort(SIMD2(point.x, point.y) / point.z) * focalLength + principalPoint
  }

  /// The point at depth 1 on the viewing ray of a pixel; inverts the distortion by Newton's method.
  package func unproject(_ pixel: SIMD2<Double>) -> SIMD2<Double> {
    let distorted = (pixel - principalPoint) / focalLength
    guard distortion != .zero else { return distorted }
    var p = distorted
    for _ in 0..<Self.maximumIterations {
      let (value, jacobian) = distortWithJacobian(p)
      let residual = value - distorted
      let determinant = jacobian.0 * jacobian.3 - jacobian.1 * jacobian.2
      guard abs(determinant) > Self.minimumDeterminant else { break }
      let step =
        SIMD2(
          jacobian.3 * residual.x - jacobian.1 * residual.y,
          jacobian.0 * residual.y - jacobian.2 * residual.x) / determinant
      p -= step
      if step.squaredLength < Self.squaredTolerance { break }
    }
    return p
  }

  /// Applies the lens distortion to normalized image coordinates.
  package func distort(_ p: SIMD2<Double>) -> SIMD2<Double> {
    let (k1, k2, p1, p2) = (distortion.x, distortion.y, distortion.z, distortion.w)
    let r2 = p.squaredLength
    let radial = 1 + r2 * (k1 + r2 * k2)
    return [
      p.x * radial + 2 * p1 * p.x * p.y + p2 * (r2 + 2 * p.x * p.x),
      p.y * radial + p1 * (r2 + 2 * p.y * p.y) + 2 * p2 * p.x * p.y,
    ]
  }

  /// The distorted point and the Jacobian of the distortion, by rows.
  private func distortWithJacobian(
    _ p: SIMD2<Double>
  ) -> (SIMD2<Double>, (Double, Double, Double, Double)) {
    let (k1, k2, p1, p2) = (distortion.x, distortion.y, distortion.z, distortion.w)
    let r2 = p.squaredLength
    let radial = 1 + r2 * (k1 + r2 * k2)
    let slope = 2 * (k1 + 2 * k2 * r2)
    let cross = slope * p.x * p.y + 2 * p1 * p.x + 2 * p2 * p.y
    return (
      distort(p),
      (
        radial + slope * p.x * p.x + 2 * p1 * p.y + 6 * p2 * p.x, cross, cross,
        radial + slope * p.y * p.y + 6 * p1 * p.y + 2 * p2 * p.x
      )
    )
  }

  /// Number of Newton iterations; the determinant of the distortion's Jacobian below which it can't
  /// be inverted; and the squared step at which the iteration has converged. Chosen.
  private static let maximumIterations = 20
  private static let minimumDeterminant = 1e-9
  private static let squaredTolerance = 1e-24

  /// Whether a pixel is inside the photo.
  package func contains(_ pixel: SIMD2<Double>) -> Bool {
    pixel.x >= 0 && pixel.y >= 0 && pixel.x < Double(width) && pixel.y < Double(height)
  }

  /// The camera of the photo resized to `width` × `height`.
  package func resized(width newWidth: Int, height newHeight: Int) -> Camera {
    let factor = SIMD2(Double(newWidth) / Double(width), Double(newHeight) / Double(height))
    var camera = self
    camera.width = newWidth
    camera.height = newHeight
    camera.focalLength *= factor
    camera.principalPoint *= factor
    return camera
  }
}

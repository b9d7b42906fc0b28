import SceneModel

extension Camera {
  /// Number of intervals in which the border of a rectangle is sampled. Chosen.
  private static let borderIntervals = 64
  /// Minimum slope of the radial distortion for its inverse to be well-defined. Chosen.
  private static let minimumSlope = 0.05
  /// How far a border ray may miss the photo, in pixels. Chosen.
  private static let borderTolerance = 0.01
  /// Factor per step by which a rectangle shrinks until the photo fills it, and number of steps.
  /// Chosen: together they shrink it to a third.
  private static let (shrinkage, maximumSteps) = (0.995, 200)
  /// Maximum size of the rectangle relative to that of a photo without distortion. Chosen.
  private static let maximumExtent = 3.0

  /// The camera without distortion whose image is the largest rectangle around the principal point
  /// that this camera's photo fills, with the same focal length if `maximumPixels` allows it.
  package func undistortedPinhole(maximumPixels: Int) -> Camera {
    var (low, high) = innerRectangle()
    // Shrink slightly if the border samples were too sparse.
    for _ in 0..<Self.maximumSteps where !isFilled(low, high) {
      low *= Self.shrinkage
      high *= Self.shrinkage
    }
    let extent = (high - low) * focalLength
    let scale = min(1, (Double(maximumPixels) / (extent.x * extent.y)).squareRoot())
    let focal = focalLength * scale
    let size = (high - low) * focal
    return Camera(
      width: max(1, Int(size.x)), height: max(1, Int(size.y)), focalLength: focal,
      principalPoint: -low * focal, calibration: calibration)
  }

  /// Corners, at depth 1, of a rectangle inside the undistorted outline of the photo.
  private func innerRectangle() -> (low: SIMD2<Double>, high: SIMD2<Double>) {
    let (w, h) = (Double(width), Double(height))
    let nominalLow = -principalPoint / focalLength
    let nominalHigh = (SIMD2(w, h) - principalPoint) / focalLength
    var (low, high) = (Self.maximumExtent * nominalLow, Self.maximumExtent * nominalHigh)
    let samples = Self.borderIntervals
    for index in 0...samples {
      let t = Double(index) / Double(samples)
      let (left, right) = (unproject([0, t * h]), unproject([w, t * h]))
      let (top, bottom) = (unproject([t * w, 0]), unproject([t * w, h]))
      if isRegular(left) { low.x = max(low.x, left.x) }
      if isRegular(right) { high.x = min(high.x, right.x) }
      if isRegular(top) { low.y = max(low.y, top.y) }
      if isRegular(bottom) { high.y = min(high.y, bottom.y) }
    }
    guard low.x < 0, low.y < 0, high.x > 0, high.y > 0 else { return (nominalLow, nominalHigh) }
    return (low, high)
  }

  /// Whether the distortion is increasing at the ray, so that it can be inverted there.
  private func isRegular(_ p: SIMD2<Double>) -> Bool {
    let r2 = p.squaredLength
    let slope = 1 + r2 * (3 * distortion.x + r2 * 5 * distortion.y)
    return r2.isFinite && slope > Self.minimumSlope
  }

  /// Whether all rays on the rectangle's border hit the photo.
  private func isFilled(_ low: SIMD2<Double>, _ high: SIMD2<Double>) -> Bool {
    let (samples, tolerance) = (Self.borderIntervals, Self.borderTolerance)
    return (0...samples).allSatisfy { index in
      let p = low + (high - low) * (Double(index) / Double(samples))
      return [SIMD2(p.x, low.y), [p.x, high.y], [low.x, p.y], [high.x, p.y]].allSatisfy {
        let pixel = distort($0) * focalLength + principalPoint
        return isRegular($0) && pixel.x >= -tolerance && pixel.y >= -tolerance
          && pixel.x <= Double(width) + tolerance && pixel.y <= Double(height) + tolerance
      }
    }
  }
}

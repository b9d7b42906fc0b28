import Foundation
import SceneModel

/// The plane that supports the object: a thin, wide layer of points with next to nothing below it.
///
/// A plain table top has few points on it; then the layer must be denser than what is directly
/// above it.
struct SupportPlane: Sendable {
  /// Unit normal, pointing to the cameras' side.
  var normal: SIMD3<Double>
  var offset: Double

  func distance(_ point: SIMD3<Double>) -> Double { normal.dot(point) - offset }

  /// Nil if no plane compatible with the cameras' up direction has enough points.
  init?(
    _ object: ObjectRegion, centers: [SIMD3<Double>], up: SIMD3<Double>,
    _ options: WorldAlignment.Options
  ) {
    guard object.surroundings.count >= 50 else { return nil }
    let thickness = options.planeThickness * object.cameraDistance
    // Most cameras are held level: planes close to their up direction are tried first.
    for degrees in [options.planeTiltDegrees / 3, options.planeTiltDegrees] {
      let found = SupportPlane(
        object.surroundings, up: up, tilt: degrees * .pi / 180, thickness, options)
      if let found, found.isSupport(object, centers, thickness, options) {
        self = found
        return
      }
    }
    return nil
  }

  /// Finds the plane by RANSAC, rewarding low points on it and penalizing points below it.
  private init?(
    _ points: [SIMD3<Double>], up: SIMD3<Double>, tilt: Double, _ thickness: Double,
    _ options: WorldAlignment.Options
  ) {
    let heights = points.map { $0.dot(up) }.sorted()
    // With an inaccurate up direction, low points may lie slightly above the median.
    let limit = heights[heights.count / 2] + 2 * thickness
    let low = points.filter { $0.dot(up) < limit }
    var random = SplitMix64(seed: options.seed)
    var best = (score: 0, normal: up, offset: 0.0)
    for _ in 0..<1000 {
      let triple = (0..<3).map { _ in low[random.below(low.count)] }
      var normal = (triple[1] - triple[0]).cross(triple[2] - triple[0]).normalized
      if normal.dot(up) < 0 { normal = -normal }
      guard normal.dot(up) > cos(tilt) else { continue }
      let offset = normal.dot(triple[0])
      let score = low.reduce(0) { sum, point in
        let height = normal.dot(point) - offset
        return abs(height) < thickness ? sum + 1 : height < -3 * thickness ? sum - 2 : sum
      }
      if score > best.score { best = (score, normal, offset) }
    }
    guard best.score > 0 else { return nil }
    (normal, offset) = (best.normal, best.offset)
    for _ in 0..<3 { refit(low, thickness, up) }
    guard normal.dot(up) > cos(tilt) else { return nil }
  }

  private func isSupport(
    _ object: ObjectRegion, _ centers: [SIMD3<Double>], _ thickness: Double,
    _ options: WorldAlignment.Options
  ) -> Bool {
    let points = object.surroundings
    let heights = points.map(distance)
    let onPlane = heights.count { abs($0) < thickness }
    let next = heights.count { $0 >= thickness && $0 < 3 * thickness }
    let above = heights.count { $0 >= thickness }
    let below = heights.count { $0 < -3 * thickness }
    let seeing = centers.count { distance($0) > 0 }
    let share = Double(onPlane) / Double(points.count)
    let isClear = share >= options.planeShare && 10 * below <= above + onPlane
    let isLayer =
      share >= options.minimumPlaneShare && onPlane >= 40 && 5 * onPlane >= 6 * next
      && 8 * below <= onPlane
      && width(points.filter { abs(distance($0)) < thickness }) >= 0.7 * width(object.core)
    // Photos are not taken from below.
    return (isClear || isLayer) && 10 * seeing >= 9 * centers.count
      && distance(object.center) > -thickness
  }

  /// The root mean square distance from the mean, measured in the plane.
  private func width(_ points: [SIMD3<Double>]) -> Double {
    guard !points.isEmpty else { return 0 }
    let flat = points.map { $0 - distance($0) * normal }
    let mean = flat.reduce(.zero, +) / Double(flat.count)
    return (flat.reduce(0) { $0 + ($1 - mean).squaredLength } / Double(flat.count)).squareRoot()
  }

  /// Least-squares fit to the points on the plane.
  private mutating func refit(
    _ points: [SIMD3<Double>], _ thickness: Double, _ up: SIMD3<Double>
  ) {
    let inliers = points.filter { abs(distance($0)) < thickness }
    guard inliers.count >= 10 else { return }
    let mean = inliers.reduce(.zero, +) / Double(inliers.count)
    var rows = [SIMD3<Double>](repeating: .zero, count: 3)
    for point in inliers {
      let d = point - mean
      for axis in 0..<3 { rows[axis] += d[axis] * d / Double(inliers.count) }
    }
    let vector = Matrix3(rows: rows[0], rows[1], rows[2]).symmetricEigen.vectors[0]
    normal = vector.dot(up) < 0 ? -vector : vector
    offset = normal.dot(mean)
  }
}

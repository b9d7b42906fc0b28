import Foundation
import SceneModel

/// Detects the plane that supports the object among the sparse points: a thin, wide layer of points
/// with next to nothing below it.
///
/// A plain table top has few points on it; then the layer must be denser than what is directly
/// above it.
struct SparseSupportDetection: Sendable {
  let options: WorldAlignment.Options

  /// Nil if no plane compatible with the cameras' up direction has enough points. `centers` are the
  /// positions of the cameras.
  func run(
    _ object: ObjectRegion, centers: [SIMD3<Double>], up: SIMD3<Double>
  ) -> SupportPlane? {
    guard object.surroundings.count >= 50 else { return nil }
    let thickness = options.planeThickness * object.cameraDistance
    // Most cameras are held level: planes close to their up direction are tried first.
    for degrees in [options.planeTiltDegrees / 3, options.planeTiltDegrees] {
      let plane = plane(
        object.surroundings, up: up, minimumCosine: cos(degrees * .pi / 180), thickness)
      if let plane, isSupport(plane, object, centers) { return plane }
    }
    return nil
  }

  /// Finds the plane by RANSAC, rewarding low points on it and penalizing points below it.
  private func plane(
    _ points: [SIMD3<Double>], up: SIMD3<Double>, minimumCosine: Double, _ thickness: Double
  ) -> SupportPlane? {
    let heights = points.map { $0.dot(up) }.sorted()
    // With an inaccurate up direction, low points may lie slightly above the median.
    let limit = heights[heights.count / 2] + 2 * thickness
    let low = points.filter { $0.dot(up) < limit }
    var random = SplitMix64(seed: options.seed)
    var best: (score: Int, plane: SupportPlane)?
    for _ in 0..<1000 {
      let triple = (0..<3).map { _ in low[random.below(low.count)] }
      var normal = (triple[1] - triple[0]).cross(triple[2] - triple[0]).normalized
      if normal.dot(up) < 0 { normal = -normal }
      guard normal.dot(up) > minimumCosine else { continue }
      let plane = SupportPlane(normal: normal, offset: normal.dot(triple[0]), band: thickness)
      let score = score(plane, low)
      if score > best?.score ?? 0 { best = (score, plane) }
    }
    guard var plane = best?.plane else { return nil }
    for _ in 0..<3 { refit(&plane, low, up) }
    return plane.normal.dot(up) > minimumCosine ? plane : nil
  }

  private func score(_ plane: SupportPlane, _ points: [SIMD3<Double>]) -> Int {
    points.reduce(0) { sum, point in
      let height = plane.height(of: point)
      return abs(height) < plane.band ? sum + 1 : height < -3 * plane.band ? sum - 2 : sum
    }
  }

  private func isSupport(
    _ plane: SupportPlane, _ object: ObjectRegion, _ centers: [SIMD3<Double>]
  ) -> Bool {
    let points = object.surroundings
    let heights = points.map(plane.height)
    let onPlane = heights.count { abs($0) < plane.band }
    let next = heights.count { $0 >= plane.band && $0 < 3 * plane.band }
    let above = heights.count { $0 >= plane.band }
    let below = heights.count { $0 < -3 * plane.band }
    let seeing = centers.count { plane.height(of: $0) > 0 }
    let share = Double(onPlane) / Double(points.count)
    let isClear = share >= options.planeShare && 10 * below <= above + onPlane
    let isLayer =
      share >= options.minimumPlaneShare && onPlane >= 40 && 5 * onPlane >= 6 * next
      && 8 * below <= onPlane
      && width(points.filter { abs(plane.height(of: $0)) < plane.band }, in: plane)
        >= 0.7 * width(object.core, in: plane)
    // Photos are not taken from below.
    return (isClear || isLayer) && 10 * seeing >= 9 * centers.count
      && plane.height(of: object.center) > -plane.band
  }

  /// The root mean square distance from the mean, measured in the plane.
  private func width(_ points: [SIMD3<Double>], in plane: SupportPlane) -> Double {
    guard !points.isEmpty else { return 0 }
    let flat = points.map { $0 - plane.height(of: $0) * plane.normal }
    let mean = flat.reduce(.zero, +) / Double(flat.count)
    return (flat.reduce(0) { $0 + ($1 - mean).squaredLength } / Double(flat.count)).squareRoot()
  }

  /// Least-squares fit, orthogonal to the plane, to the points on it.
  private func refit(
    _ plane: inout SupportPlane, _ points: [SIMD3<Double>], _ up: SIMD3<Double>
  ) {
    let inliers = points.filter { abs(plane.height(of: $0)) < plane.band }
    guard inliers.count >= 10 else { return }
    let mean = inliers.reduce(.zero, +) / Double(inliers.count)
    let vector = Matrix3(scatterOf: inliers, about: mean).symmetricEigen.vectors[0]
    plane.normal = vector.dot(up) < 0 ? -vector : vector
    plane.offset = plane.normal.dot(mean)
  }
}

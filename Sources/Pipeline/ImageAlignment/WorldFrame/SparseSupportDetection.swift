import Foundation
import SceneModel

/// Detects the plane that supports the object among the sparse points: a thin, wide layer of points
/// with next to nothing below it.
///
/// A plain table top has few points on it; then the layer must be denser than what is directly
/// above it.
struct SparseSupportDetection: Sendable {
  /// Number of RANSAC hypotheses, and of fits to the points on the best one. Chosen.
  private static let (iterations, refinements) = (1000, 3)
  /// Minimum number of points around the object, of points on an unambiguous layer, and of points
  /// that a plane is fitted to. Chosen.
  private static let (minimumPoints, minimumLayerPoints, minimumFitPoints) = (50, 40, 10)
  /// Points lower than this number of thicknesses are below the plane. Chosen.
  private static let belowFactor = -3.0
  /// Points up to this number of thicknesses are directly above the plane. Chosen.
  private static let aboveFactor = 3.0
  /// Score of a point below the plane; a point on it has 1. Chosen.
  private static let belowScore = -2
  /// Minimum width of a layer relative to that of the object. Chosen.
  private static let minimumLayerWidth = 0.7

  let options: WorldAlignment.Options

  /// Nil if no plane compatible with the cameras' up direction has enough points. `centers` are the
  /// positions of the cameras.
  func run(
    _ object: ObjectRegion, centers: [SIMD3<Double>], up: SIMD3<Double>
  ) -> SupportPlane? {
    guard object.surroundings.count >= Self.minimumPoints else { return nil }
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
    for _ in 0..<Self.iterations {
      let triple = (0..<3).map { _ in low[random.below(low.count)] }
      var normal = (triple[1] - triple[0]).cross(triple[2] - triple[0]).normalized
      if normal.dot(up) < 0 { normal = -normal }
      guard normal.dot(up) > minimumCosine else { continue }
      let plane = SupportPlane(normal: normal, offset: normal.dot(triple[0]), band: thickness)
      let score = score(plane, low)
      if score > best?.score ?? 0 { best = (score, plane) }
    }
    guard var plane = best?.plane else { return nil }
    for _ in 0..<Self.refinements { refit(&plane, low, up) }
    return plane.normal.dot(up) > minimumCosine ? plane : nil
  }

  /// The number of points on the plane, less a penalty for points below it.
  private func score(_ plane: SupportPlane, _ points: [SIMD3<Double>]) -> Int {
    points.reduce(0) { sum, point in
      let height = plane.height(of: point)
      return abs(height) < plane.band
        ? sum + 1 : height < Self.belowFactor * plane.band ? sum + Self.belowScore : sum
    }
  }

  /// Whether the plane stands out among the points and is plausible for the cameras.
  private func isSupport(
    _ plane: SupportPlane, _ object: ObjectRegion, _ centers: [SIMD3<Double>]
  ) -> Bool {
    let points = object.surroundings
    let heights = points.map(plane.height)
    let onPlane = heights.count { abs($0) < plane.band }
    let next = heights.count { $0 >= plane.band && $0 < Self.aboveFactor * plane.band }
    let above = heights.count { $0 >= plane.band }
    let below = heights.count { $0 < Self.belowFactor * plane.band }
    let seeing = centers.count { plane.height(of: $0) > 0 }
    let share = Double(onPlane) / Double(points.count)
    // Unambiguous: ten times as many points on and above the plane as below it.
    let isClear = share >= options.planeShare && 10 * below <= above + onPlane
    // A layer: a fifth denser than what is directly above it, with eight times as many points as
    // below it, and almost as wide as the object.
    let isLayer =
      share >= options.minimumPlaneShare && onPlane >= Self.minimumLayerPoints
      && 5 * onPlane >= 6 * next && 8 * below <= onPlane
      && width(points.filter { abs(plane.height(of: $0)) < plane.band }, in: plane)
        >= Self.minimumLayerWidth * width(object.core, in: plane)
    // Photos are not taken from below: nine tenths of the cameras are above the plane.
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
    guard inliers.count >= Self.minimumFitPoints else { return }
    let mean = inliers.reduce(.zero, +) / Double(inliers.count)
    let vector = Matrix3(scatterOf: inliers, about: mean).symmetricEigen.vectors[0]
    plane.normal = vector.dot(up) < 0 ? -vector : vector
    plane.offset = plane.normal.dot(mean)
  }
}

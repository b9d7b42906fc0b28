import Foundation
import SceneModel

/// The robust similarity fit of the camera centers of a reconstruction to the photos' GPS
/// positions.
struct GPSFit: Sendable {
  /// Residuals of the GPS positions after the fit, in meters.
  struct Residual: Hashable, Sendable {
    /// Root mean squares over the inliers; `vertical` is nil without altitudes.
    var horizontal: Double
    var vertical: Double?
    /// Number of inliers, and of all positions.
    var used: Int
    var count: Int
  }

  /// Meters per unit of the reconstruction.
  var scale: Double
  /// Up direction in the frame of the reconstruction; nil if it is undetermined because the
  /// positions are nearly collinear or too noisy.
  var up: SIMD3<Double>?
  var residual: Residual
  /// The inliers: centers in the reconstruction and in the world (east, up, south).
  private var inliers: [Located]

  private struct Located: Sendable {
    var center: SIMD3<Double>
    var world: SIMD3<Double>
  }

  /// Nil unless at least three positions agree with the camera centers and spread well beyond their
  /// error.
  ///
  /// `priorUp` is the vertical known from another source. If altitudes are missing, the fit is
  /// horizontal only: the centers are projected along `priorUp`.
  init?(
    _ reconstruction: Reconstruction, up priorUp: SIMD3<Double>, _ options: WorldAlignment.Options
  ) {
    let located = reconstruction.photos.compactMap { photo in
      reconstruction.poses[photo.id.index].flatMap { pose in
        photo.position.map { (center: pose.center, position: $0) }
      }
    }
    guard located.count >= 3 else { return nil }
    let hasAltitudes = located.allSatisfy { $0.position.altitude != nil }
    let world = Self.local(located.map(\.position))
    let needed = options.gpsSpreadFactor * options.gpsNoise
    guard Self.spread(world).largest > needed else { return nil }
    let pairs = zip(located, world).map { located, world in
      let height = hasAltitudes ? 0 : located.center.dot(priorUp)
      return Located(center: located.center - height * priorUp, world: world)
    }
    guard let (fit, used) = Self.robustFit(pairs, options) else { return nil }
    inliers = used
    scale = fit.scale
    residual = Self.residual(fit, used, of: pairs.count, hasAltitudes)
    // A vertical error tilts the ground less the wider and the more numerous the positions are.
    let width = Self.spread(used.map(\.world)).second / 2
    let vertical = max(
      residual.vertical ?? .infinity, options.gpsMinimumVerticalShare * options.gpsNoise)
    let tilt = vertical / (max(width, 1e-9) * Double(max(1, used.count - 3)).squareRoot())
    let isKnown = hasAltitudes && tilt < options.gpsTiltDegrees * .pi / 180
    up = isKnown ? fit.rotation.conjugate * SIMD3(0, 1, 0) : nil
  }

  /// The rotation about +y, in radians, that aligns a leveled reconstruction with the world's
  /// heading.
  func yaw(leveling: Quaternion) -> Double {
    let count = Double(inliers.count)
    let centerMean = inliers.reduce(SIMD3<Double>.zero) { $0 + $1.center } / count
    let worldMean = inliers.reduce(SIMD3<Double>.zero) { $0 + $1.world } / count
    var (sine, cosine) = (0.0, 0.0)
    for pair in inliers {
      let (a, b) = (leveling * (pair.center - centerMean), pair.world - worldMean)
      sine += a.z * b.x - a.x * b.z
      cosine += a.x * b.x + a.z * b.z
    }
    return atan2(sine, cosine)
  }

  /// Meters to the east, up and south of the mean position (WGS 84).
  private static func local(_ positions: [GeographicPosition]) -> [SIMD3<Double>] {
    let altitudes = positions.compactMap(\.altitude)
    let hasAll = altitudes.count == positions.count
    let height = altitudes.isEmpty ? 0 : altitudes.reduce(0, +) / Double(altitudes.count)
    let earth = positions.map { earthCentered($0, hasAll ? $0.altitude ?? height : height) }
    let mean = earth.reduce(.zero, +) / Double(earth.count)
    let latitude = positions[0].latitudeDegrees * .pi / 180
    let longitude = positions[0].longitudeDegrees * .pi / 180
    let east = SIMD3(-sin(longitude), cos(longitude), 0)
    let up = SIMD3(
      cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude))
    let south = east.cross(up)
    return earth.map { [($0 - mean).dot(east), ($0 - mean).dot(up), ($0 - mean).dot(south)] }
  }

  /// Earth-centered, Earth-fixed coordinates in meters (WGS 84 ellipsoid).
  private static func earthCentered(
    _ position: GeographicPosition, _ altitude: Double
  ) -> SIMD3<Double> {
    // Limit: the semi-major axis and the squared eccentricity of WGS 84.
    let (a, e2) = (6_378_137.0, 6.694_379_990_14e-3)
    let latitude = position.latitudeDegrees * .pi / 180
    let longitude = position.longitudeDegrees * .pi / 180
    let n = a / (1 - e2 * sin(latitude) * sin(latitude)).squareRoot()
    return [
      (n + altitude) * cos(latitude) * cos(longitude),
      (n + altitude) * cos(latitude) * sin(longitude), (n * (1 - e2) + altitude) * sin(latitude),
    ]
  }

  /// Twice the standard deviations along the two directions of largest variance.
  private static func spread(_ points: [SIMD3<Double>]) -> (largest: Double, second: Double) {
    let mean = points.reduce(.zero, +) / Double(max(1, points.count))
    let values = Matrix3(scatterOf: points, about: mean).symmetricEigen.values
    return (2 * max(0, values[2]).squareRoot(), 2 * max(0, values[1]).squareRoot())
  }

  /// The root mean square errors of a fit over its inliers.
  private static func residual(
    _ fit: SimilarityTransform, _ used: [Located], of count: Int, _ hasAltitudes: Bool
  ) -> Residual {
    let errors = used.map { fit * $0.center - $0.world }
    let number = Double(max(1, errors.count))
    let horizontal = errors.reduce(0) { $0 + $1.x * $1.x + $1.z * $1.z } / number
    let vertical = errors.reduce(0) { $0 + $1.y * $1.y } / number
    return Residual(
      horizontal: horizontal.squareRoot(), vertical: hasAltitudes ? vertical.squareRoot() : nil,
      used: used.count, count: count)
  }

  /// The least-squares similarity over the inliers, found by RANSAC; nil unless more than half of
  /// the pairs are inliers.
  private static func robustFit(
    _ pairs: [Located], _ options: WorldAlignment.Options
  ) -> (SimilarityTransform, [Located])? {
    var random = SplitMix64(seed: options.seed)
    var best: SimilarityTransform?
    var bestScore = Double.infinity
    let limit = options.gpsInlierFactor * options.gpsNoise
    func error(_ fit: SimilarityTransform, _ pair: Located) -> Double {
      (fit * pair.center - pair.world).length
    }
    for round in 0..<options.gpsIterations {
      // The first hypothesis is the fit to all pairs.
      let sample =
        round == 0
        ? pairs : (0..<options.gpsSampleSize).map { _ in pairs[random.below(pairs.count)] }
      guard
        let fit = SimilarityTransform.fitting(sample.map(\.center), to: sample.map(\.world))
      else { continue }
      let score = pairs.reduce(0) { $0 + min(limit, error(fit, $1)) }
      if score < bestScore { (best, bestScore) = (fit, score) }
    }
    guard var fit = best else { return nil }
    var used: [Located] = []
    for _ in 0..<options.gpsRefinements {
      used = pairs.filter { error(fit, $0) < limit }
      guard used.count >= 3, 2 * used.count > pairs.count,
        let refined = SimilarityTransform.fitting(used.map(\.center), to: used.map(\.world))
      else { return nil }
      fit = refined
    }
    return (fit, used)
  }
}

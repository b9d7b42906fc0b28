import Foundation
import SceneModel

/// How the photos' GPS positions lie to the reconstruction's camera centres.
struct GPSFit: Sendable {
  /// Metres per unit of the reconstruction.
  var scale: Double
  /// Up in the reconstruction; nil where positions on a line leave it open.
  var up: SIMD3<Double>?
  /// Centres in the reconstruction and in the world (east, up, south) that agree.
  private var inliers: [(center: SIMD3<Double>, world: SIMD3<Double>)]

  /// Nil without three positions that spread well over their error and agree with the centres.
  init?(_ reconstruction: Reconstruction, _ options: WorldFraming.Options) {
    let located = reconstruction.photos.compactMap { photo in
      reconstruction.poses[photo.id.index].flatMap { pose in
        photo.position.map { (center: pose.center, position: $0) }
      }
    }
    guard located.count >= 3 else { return nil }
    let world = Self.local(located.map(\.position))
    let needed = options.gpsSpreadFactor * options.gpsNoise
    guard Self.spread(world).largest > needed else { return nil }
    let pairs = zip(located, world).map { (center: $0.center, world: $1) }
    guard let fit = Self.robustFit(pairs, options) else { return nil }
    inliers = pairs.filter {
      (fit * $0.center - $0.world).length < 3 * options.gpsNoise
    }
    guard inliers.count >= 3, 2 * inliers.count > pairs.count,
      let refined = SimilarityTransform.fitting(inliers.map(\.center), to: inliers.map(\.world))
    else { return nil }
    scale = refined.scale
    let isOpen = Self.spread(inliers.map(\.world)).second < needed
    up = isOpen ? nil : refined.rotation.conjugate * SIMD3(0, 1, 0)
  }

  /// The turn about +y that makes a levelled reconstruction face as the world does.
  func yaw(leveling: Quaternion) -> Double {
    let count = Double(inliers.count)
    let centerMean = inliers.reduce(SIMD3<Double>.zero) { $0 + $1.center } / count
    let worldMean = inliers.reduce(SIMD3<Double>.zero) { $0 + $1.world } / count
    var (sine, cosine) = (0.0, 0.0)
    for (center, world) in inliers {
      let (a, b) = (leveling * (center - centerMean), world - worldMean)
      sine += a.z * b.x - a.x * b.z
      cosine += a.x * b.x + a.z * b.z
    }
    return atan2(sine, cosine)
  }

  /// Metres to the east, up and south of the mean position (WGS 84).
  private static func local(_ positions: [GeographicPosition]) -> [SIMD3<Double>] {
    let altitudes = positions.compactMap(\.altitude)
    let height = altitudes.isEmpty ? 0 : altitudes.reduce(0, +) / Double(altitudes.count)
    let earth = positions.map { earthCentered($0, $0.altitude ?? height) }
    let mean = earth.reduce(.zero, +) / Double(earth.count)
    let latitude = positions[0].latitudeDegrees * .pi / 180
    let longitude = positions[0].longitudeDegrees * .pi / 180
    let east = SIMD3(-sin(longitude), cos(longitude), 0)
    let up = SIMD3(
      cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude))
    let south = east.cross(up)
    return earth.map { [($0 - mean).dot(east), ($0 - mean).dot(up), ($0 - mean).dot(south)] }
  }

  private static func earthCentered(
    _ position: GeographicPosition, _ altitude: Double
  ) -> SIMD3<Double> {
    let (a, e2) = (6_378_137.0, 6.694_379_990_14e-3)
    let latitude = position.latitudeDegrees * .pi / 180
    let longitude = position.longitudeDegrees * .pi / 180
    let n = a / (1 - e2 * sin(latitude) * sin(latitude)).squareRoot()
    return [
      (n + altitude) * cos(latitude) * cos(longitude),
      (n + altitude) * cos(latitude) * sin(longitude), (n * (1 - e2) + altitude) * sin(latitude),
    ]
  }

  /// Twice the standard deviations along the two widest directions.
  private static func spread(_ points: [SIMD3<Double>]) -> (largest: Double, second: Double) {
    let mean = points.reduce(.zero, +) / Double(max(1, points.count))
    var rows = [SIMD3<Double>](repeating: .zero, count: 3)
    for point in points {
      let d = point - mean
      for axis in 0..<3 { rows[axis] += d[axis] * d / Double(points.count) }
    }
    let values = Matrix3(rows: rows[0], rows[1], rows[2]).symmetricEigen.values
    return (2 * max(0, values[2]).squareRoot(), 2 * max(0, values[1]).squareRoot())
  }

  /// The similarity through a few pairs that the others agree with most.
  private static func robustFit(
    _ pairs: [(center: SIMD3<Double>, world: SIMD3<Double>)], _ options: WorldFraming.Options
  ) -> SimilarityTransform? {
    var random = SplitMix64(state: options.seed)
    var best: SimilarityTransform?
    var bestScore = Double.infinity
    let limit = 3 * options.gpsNoise
    for round in 0..<300 {
      // The first hypothesis is the fit of all.
      let sample =
        round == 0
        ? pairs : (0..<4).map { _ in pairs[Int(random.next() % UInt64(pairs.count))] }
      guard
        let fit = SimilarityTransform.fitting(sample.map(\.center), to: sample.map(\.world))
      else { continue }
      let score = pairs.reduce(0) { sum, pair in
        sum + min(limit, (fit * pair.center - pair.world).length)
      }
      if score < bestScore { (best, bestScore) = (fit, score) }
    }
    return best
  }
}

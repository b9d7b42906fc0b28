import Foundation
import SceneModel

/// The scale that depth maps of the photos give a reconstruction.
///
/// Each photo has the median of depth by map over depth in the reconstruction, over the sparse points
/// that it sees; the scale is the mean of the photos that agree. Maps that may hold disparities are
/// tried as both.
struct DepthScale: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Points of a photo whose depth its map knows.
    var minimumPoints = 20
    /// Median deviation of a photo's points from their median, relative: a map with more is of
    /// something else, or not in metres along the axis.
    var maximumDeviation = 0.1
    /// Photos agree within this, relative.
    var tolerance = 0.1
    /// Share of the photos with maps that have to agree.
    var minimumShare = 0.5
  }

  var options = Options()

  /// Metres per unit. `readings` are by sample id. Nil where no map can be used, or they contradict
  /// each other.
  func run(
    _ readings: [Int: SensorReading], _ reconstruction: Reconstruction, _ notes: StageNotes
  ) -> Double? {
    guard readings.values.contains(where: { $0.depth != nil }) else { return nil }
    let asDepths = agreement(readings, reconstruction, isDisparity: false)
    let asDisparities = agreement(readings, reconstruction, isDisparity: true)
    let best = asDisparities.isBetter(than: asDepths) ? asDisparities : asDepths
    guard best.maps > 0 else { return nil }
    notes.count("depthMaps", Double(best.maps))
    notes.count("depthMapsUsed", Double(best.scales.count))
    guard Double(best.scales.count) >= options.minimumShare * Double(best.maps) else {
      notes.warn(
        "The depth maps are not used: only \(best.scales.count) of \(best.maps) agree with each "
          + "other and with the photos. They are meant in metres along the optical axis.")
      return nil
    }
    notes.tell(
      "Depth maps: \(best.scales.count) of \(best.maps) agree about the scale, "
        + String(format: "%.1f %% off (root mean square).", 100 * best.spread))
    return exp(best.mean)
  }

  /// The photos that agree about the scale.
  private struct Agreement {
    /// Photos with a map.
    var maps: Int
    /// Logarithms of metres per unit.
    var scales: [Double] = []
    /// Mean of the median deviations of their points.
    var deviation = 0.0

    var mean: Double { scales.reduce(0, +) / Double(max(1, scales.count)) }

    /// Root mean square of the deviations from the mean.
    var spread: Double {
      let squares = scales.reduce(0) { $0 + ($1 - mean) * ($1 - mean) }
      return (squares / Double(max(1, scales.count))).squareRoot()
    }

    func isBetter(than other: Agreement) -> Bool {
      (scales.count, -deviation) > (other.scales.count, -other.deviation)
    }
  }

  private func agreement(
    _ readings: [Int: SensorReading], _ reconstruction: Reconstruction, isDisparity: Bool
  ) -> Agreement {
    let ratios = ratios(readings, reconstruction, isDisparity: isDisparity)
    let found = ratios.compactMap { consensus($0) }
    let middle = found.map(\.scale).upperMedian ?? 0
    let agreeing = found.filter { abs($0.scale - middle) < options.tolerance }
    let deviation = agreeing.reduce(0) { $0 + $1.deviation } / Double(max(1, agreeing.count))
    return Agreement(maps: ratios.count, scales: agreeing.map(\.scale), deviation: deviation)
  }

  /// Of each photo with a map, the logarithms of depth by map over depth in the reconstruction.
  private func ratios(
    _ readings: [Int: SensorReading], _ reconstruction: Reconstruction, isDisparity: Bool
  ) -> [[Double]] {
    let maps = reconstruction.photos.map { readings[$0.sampleID]?.depth }
    var ratios = [[Double]](repeating: [], count: maps.count)
    for point in reconstruction.points {
      for observation in point.track {
        let index = observation.photo.index
        guard let map = maps[index], let pose = reconstruction.poses[index] else { continue }
        let photo = reconstruction.photos[index]
        let place = observation.pixel / SIMD2(Double(photo.width), Double(photo.height))
        let depth = (pose * point.position).z
        guard depth > 0, let measured = map.depth(at: place) else { continue }
        let isInverse = isDisparity && map.mayBeDisparities
        ratios[index].append(log((isInverse ? 1 / measured : measured) / depth))
      }
    }
    return ratios.indices
      .filter { maps[$0] != nil && reconstruction.poses[$0] != nil }.map { ratios[$0] }
  }

  /// The median and the points' median deviation from it; nil for too few points, or points that
  /// disagree.
  private func consensus(_ ratios: [Double]) -> (scale: Double, deviation: Double)? {
    guard ratios.count >= options.minimumPoints, let middle = ratios.upperMedian,
      let deviation = ratios.map({ abs($0 - middle) }).upperMedian,
      deviation <= options.maximumDeviation
    else { return nil }
    return (middle, deviation)
  }
}

import Foundation
import SceneModel

/// The metric scale of a reconstruction from the depth maps of its photos.
///
/// For each photo, the median ratio of measured to reconstructed depth is taken over the sparse
/// points that it observes; the scale is the mean over the photos that agree. Maps that may hold
/// disparities are evaluated both as depths and as disparities.
struct DepthMapScale: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum number of points of a photo with a measured depth. Chosen.
    var minimumPoints = 20
    /// Maximum median deviation of a photo's points from their median, relative. A map that exceeds
    /// it shows something else, or is not in meters along the optical axis. Chosen.
    var maximumDeviation = 0.1
    /// Maximum relative deviation of a photo's scale from the median over the photos. Chosen.
    var tolerance = 0.1
    /// Minimum fraction of the photos with depth maps that must agree. Chosen.
    var minimumShare = 0.5
  }

  var options = Options()

  /// Returns meters per unit of the reconstruction; `readings` are keyed by sample ID. Nil if no
  /// map is usable or the maps contradict each other.
  func run(
    _ readings: [Int: SensorReading], _ reconstruction: Reconstruction, _ notes: StageNotes
  ) -> Double? {
    guard readings.values.contains(where: { $0.depth != nil }) else { return nil }
    let asDepths = agreement(readings, reconstruction, isDisparity: false)
    let asDisparities = agreement(readings, reconstruction, isDisparity: true)
    let best = asDisparities.isBetter(than: asDepths) ? asDisparities : asDepths
    guard best.maps > 0 else { return nil }
    notes.record("depthMaps", Double(best.maps))
    notes.record("depthMapsUsed", Double(best.scales.count))
    guard Double(best.scales.count) >= options.minimumShare * Double(best.maps) else {
      notes.warn(
        "The depth maps are not used: only \(best.scales.count) of \(best.maps) agree with each "
          + "other and with the photos. Depth maps must be in meters along the optical axis.")
      return nil
    }
    notes.log(
      "Depth maps: \(best.scales.count) of \(best.maps) agree on the scale, "
        + String(format: "with a root mean square deviation of %.1f %%.", 100 * best.spread))
    return exp(best.mean)
  }

  /// The photos that agree on the scale.
  private struct Agreement {
    /// Number of photos with a map.
    var maps: Int
    /// Logarithms of meters per unit, one per agreeing photo.
    var scales: [Double] = []
    /// Mean over the photos of the median deviation of their points.
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

  /// For each photo with a map, the logarithms of the ratio of measured to reconstructed depth.
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
        let position = observation.pixel / SIMD2(Double(photo.width), Double(photo.height))
        let depth = (pose * point.position).z
        guard depth > 0, let measured = map.depth(at: position) else { continue }
        let isInverse = isDisparity && map.mayBeDisparities
        ratios[index].append(log((isInverse ? 1 / measured : measured) / depth))
      }
    }
    return ratios.indices
      .filter { maps[$0] != nil && reconstruction.poses[$0] != nil }.map { ratios[$0] }
  }

  /// The median and the median absolute deviation from it; nil for too few points or points that
  /// disagree.
  private func consensus(_ ratios: [Double]) -> (scale: Double, deviation: Double)? {
    guard ratios.count >= options.minimumPoints, let middle = ratios.upperMedian,
      let deviation = ratios.map({ abs($0 - middle) }).upperMedian,
      deviation <= options.maximumDeviation
    else { return nil }
    return (middle, deviation)
  }
}

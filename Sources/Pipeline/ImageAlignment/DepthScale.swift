import Foundation
import SceneModel

/// The scale that depth maps of the photos give a reconstruction.
///
/// Each photo has the median of depth by map over depth in the reconstruction, over the sparse points
/// that it sees; the scale is the mean of the photos that agree.
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
    let ratios = ratios(readings, reconstruction)
    let scales = ratios.compactMap { consensus($0) }
    guard !ratios.isEmpty else { return nil }
    let middle = scales.upperMedian ?? 0
    let agreeing = scales.filter { abs($0 - middle) < options.tolerance }
    notes.count("depthMaps", Double(ratios.count))
    notes.count("depthMapsUsed", Double(agreeing.count))
    guard Double(agreeing.count) >= options.minimumShare * Double(ratios.count) else {
      notes.warn(
        "The samples' depth maps are not used: only \(agreeing.count) of \(ratios.count) agree with "
          + "each other and with the photos. They are meant in metres along the optical axis.")
      return nil
    }
    let mean = agreeing.reduce(0, +) / Double(agreeing.count)
    let square = agreeing.reduce(0) { $0 + ($1 - mean) * ($1 - mean) } / Double(agreeing.count)
    notes.tell(
      "Depth maps: \(agreeing.count) of \(ratios.count) agree about the scale, "
        + String(format: "%.1f %% off (root mean square).", 100 * square.squareRoot()))
    return exp(mean)
  }

  /// Of each photo with a map, the logarithms of depth by map over depth in the reconstruction.
  private func ratios(
    _ readings: [Int: SensorReading], _ reconstruction: Reconstruction
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
        ratios[index].append(log(measured / depth))
      }
    }
    return ratios.indices
      .filter { maps[$0] != nil && reconstruction.poses[$0] != nil }.map { ratios[$0] }
  }

  /// The median; nil for too few points, or points that disagree.
  private func consensus(_ ratios: [Double]) -> Double? {
    guard ratios.count >= options.minimumPoints, let middle = ratios.upperMedian,
      let deviation = ratios.map({ abs($0 - middle) }).upperMedian,
      deviation <= options.maximumDeviation
    else { return nil }
    return middle
  }
}

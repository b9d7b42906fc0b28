import Foundation
import Kernels
import SceneModel

/// What a dense cloud is worth: how much denser it is than the sparse points, how much of them it
/// covers, and how many points it has a cubic metre.
package struct CloudMetrics: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// A sparse point is covered where the nearest dense point is within so many of its footprints.
    package var coverageFootprints = 3.0
    /// Share of the points beyond each side of the box whose volume counts, so that strays don't.
    package var boxQuantile = 0.01

    package init() {}
  }

  package struct Values: Hashable, Sendable {
    package var points: Int
    package var sparsePoints: Int
    /// Share of the sparse points that the cloud covers.
    package var sparseCoverage: Double
    /// Nil where the unit isn't the metre, or where the points are all in a plane.
    package var pointsPerCubicMeter: Double?

    /// Dense points for each sparse point.
    package var pointsPerSparsePoint: Double { Double(points) / Double(max(1, sparsePoints)) }
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Measures `cloud` and puts the figures into the report.
  @discardableResult
  package func run(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> Values {
    let values = Values(
      points: cloud.count, sparsePoints: reconstruction.points.count,
      sparseCoverage: try coverage(of: reconstruction.points, by: cloud, context.control),
      pointsPerCubicMeter: reconstruction.worldFrame.scale.isMetric ? density(cloud) : nil)
    report(values, context.notes)
    return values
  }

  private func coverage(
    of points: [ScenePoint], by cloud: PointCloud, _ control: KernelControl
  ) throws -> Double {
    let places = points.map { SIMD3<Float>($0.position) }
      .filter { $0.x.isFinite && $0.y.isFinite && $0.z.isFinite }
    guard !places.isEmpty, cloud.count > 0 else { return 0 }
    let nearest = try NearestPoints(of: places, in: cloud.positions, control)
    let factor = Float(options.coverageFootprints)
    let covered = zip(nearest.indices, nearest.distances).count { index, distance in
      index >= 0 && distance <= factor * cloud.footprints[Int(index)]
    }
    return Double(covered) / Double(points.count)
  }

  /// Points in a unit of volume of the box that holds all but the outermost.
  private func density(_ cloud: PointCloud) -> Double? {
    guard cloud.count > 0 else { return nil }
    let outer = Int(options.boxQuantile * Double(cloud.count))
    var (low, high) = (SIMD3<Float>.zero, SIMD3<Float>.zero)
    for axis in 0..<3 {
      let values = cloud.positions.map { $0[axis] }.sorted()
      (low[axis], high[axis]) = (values[outer], values[values.count - 1 - outer])
    }
    let inside = cloud.positions.count { point in
      (0..<3).allSatisfy { point[$0] >= low[$0] && point[$0] <= high[$0] }
    }
    let size = SIMD3<Double>(high - low)
    let volume = size.x * size.y * size.z
    return volume > 0 ? Double(inside) / volume : nil
  }

  private func report(_ values: Values, _ notes: StageNotes) {
    notes.count("sparsePoints", Double(values.sparsePoints))
    notes.count("pointsPerSparsePoint", values.pointsPerSparsePoint)
    notes.count("sparseCoverage", values.sparseCoverage)
    var parts = [
      "\(values.points) points, \(Int(values.pointsPerSparsePoint.rounded())) for each sparse point"
    ]
    if let ratio = notes.counts["acceptedPixelRatio"] {
      parts.append("\(percent(ratio)) of the views' pixels measured")
    }
    parts.append("\(percent(values.sparseCoverage)) of the sparse points covered")
    if let density = values.pointsPerCubicMeter {
      notes.count("pointsPerCubicMeter", density)
      parts.append(String(format: "%.3g points/m³", density))
    }
    notes.tell(parts.joined(separator: "; ") + ".")
  }

  private func percent(_ ratio: Double) -> String { String(format: "%.0f %%", 100 * ratio) }
}

import Foundation
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
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ notes: StageNotes
  ) -> Values {
    let values = Values(
      points: cloud.count, sparsePoints: reconstruction.points.count,
      sparseCoverage: coverage(of: reconstruction.points, by: cloud),
      pointsPerCubicMeter: reconstruction.worldFrame.scale.isMetric ? density(cloud) : nil)
    report(values, notes)
    return values
  }

  private func coverage(of points: [ScenePoint], by cloud: PointCloud) -> Double {
    let places = points.map { SIMD3<Float>($0.position) }
      .filter { $0.x.isFinite && $0.y.isFinite && $0.z.isFinite }
    guard !places.isEmpty, cloud.count > 0 else { return 0 }
    // A few points that are far away shall not make the cells large for all.
    let typical = stride(from: 0, to: cloud.count, by: 1 + cloud.count / 10_000)
      .map { cloud.footprints[$0] }.sorted()
    let factor = Float(options.coverageFootprints)
    let reach = factor * typical[typical.count * 9 / 10]
    var grid = PlaceGrid(places, reach: reach)
    for index in 0..<cloud.count {
      grid.mark(cloud.positions[index], within: min(reach, factor * cloud.footprints[index]))
    }
    return Double(grid.markedCount) / Double(points.count)
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

/// Places by the cells of a grid around them, to mark those that many points come near to: a k-d tree
/// of the points would take longer to build.
private struct PlaceGrid {
  private let places: [SIMD3<Float>]
  private let inverseCell: Float
  private var cells: [SIMD3<Int32>: [Int32]] = [:]
  private var isMarked: [Bool]

  /// Each place is in its own cell and those around it, which are `reach` wide.
  init(_ places: [SIMD3<Float>], reach: Float) {
    self.places = places
    inverseCell = 1 / max(reach, .leastNormalMagnitude)
    isMarked = [Bool](repeating: false, count: places.count)
    for (index, place) in places.enumerated() {
      guard let center = cell(of: place) else { continue }
      for offset in 0..<27 {
        let step = SIMD3(Int32(offset % 3), Int32(offset / 3 % 3), Int32(offset / 9)) &- 1
        cells[center &+ step, default: []].append(Int32(index))
      }
    }
  }

  var markedCount: Int { isMarked.count { $0 } }

  mutating func mark(_ point: SIMD3<Float>, within distance: Float) {
    guard let cell = cell(of: point), let near = cells[cell] else { return }
    for index in near {
      let way = places[Int(index)] - point
      if (way * way).sum() <= distance * distance { isMarked[Int(index)] = true }
    }
  }

  /// Nil where the point is too far away to number its cell, or not a number.
  private func cell(of point: SIMD3<Float>) -> SIMD3<Int32>? {
    let scaled = (point * inverseCell).rounded(.down)
    guard (0..<3).allSatisfy({ abs(scaled[$0]) < 1e9 }) else { return nil }
    return SIMD3<Int32>(scaled)
  }
}

import Foundation
import Kernels
import SceneModel

/// Quality metrics of a dense cloud: density relative to the sparse points, coverage of the sparse
/// points, and points per cubic meter.
package struct CloudMetrics: Sendable {
  /// Parameters of the metrics.
  package struct Options: Hashable, Codable, Sendable {
    /// A sparse point is covered if the nearest dense point is within this many of its footprints.
    /// Chosen.
    package var coverageFootprints = 3.0
    /// Share of the points trimmed at each side of the box whose volume counts, so that outliers
    /// don't enlarge it. Chosen.
    package var boxQuantile = 0.01
    /// Maximum number of sparse points whose coverage is looked up, and of points that determine
    /// the box; evenly chosen from all. Chosen: shares are then known to 0.2 %.
    package var sampleSize = 100_000

    package init() {}
  }

  /// The measured figures.
  package struct Values: Hashable, Sendable {
    /// Points of the dense cloud.
    package var points: Int
    /// Points of the sparse reconstruction.
    package var sparsePoints: Int
    /// Share of the sparse points that the cloud covers.
    package var sparseCoverage: Double
    /// Points per m³; nil if the unit isn't the meter or the points are coplanar.
    package var pointsPerCubicMeter: Double?

    /// Dense points for each sparse point.
    package var pointsPerSparsePoint: Double { Double(points) / Double(max(1, sparsePoints)) }
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Measures `cloud` and records the figures in the report.
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

  /// The share of the sparse points, 0…1, that have a dense point within reach.
  private func coverage(
    of points: [ScenePoint], by cloud: PointCloud, _ control: KernelControl
  ) throws -> Double {
    let sample = sample(of: points.count)
    let sparsePositions = sample.map { SIMD3<Float>(points[$0].position) }.filter(\.isFinite)
    guard !sparsePositions.isEmpty, cloud.count > 0 else { return 0 }
    // A few distant points must not enlarge the cells for all.
    let typical = stride(from: 0, to: cloud.count, by: 1 + cloud.count / 10_000)
      .map { cloud.footprints[$0] }.sorted()
    let factor = Float(options.coverageFootprints)
    let reach = factor * typical[typical.count * 9 / 10]
    let grid = PointGrid(sparsePositions, reach: reach)
    let unit = 1 << 17  // Dense points of a unit of parallel work. Chosen.
    let near = try control.parallelMap(0..<cloud.count, perUnitOf: unit) { range in
      grid.points(near: range, of: cloud) { min(reach, factor * cloud.footprints[$0]) }
    }
    var isCovered = [Bool](repeating: false, count: sparsePositions.count)
    for index in near.joined() { isCovered[index] = true }
    return Double(isCovered.count { $0 }) / Double(sample.count)
  }

  /// Evenly chosen numbers of points.
  private func sample(of count: Int) -> [Int] {
    Array(stride(from: 0, to: count, by: 1 + count / options.sampleSize))
  }

  /// Points per unit of volume of the box that holds all but the outermost points; nil for a box
  /// without volume.
  private func density(_ cloud: PointCloud) -> Double? {
    guard cloud.count > 0 else { return nil }
    let sample = sample(of: cloud.count)
    let outer = Int(options.boxQuantile * Double(sample.count))
    let sides = (0..<3).map { axis in
      let values = sample.map { cloud.positions[$0][axis] }
      return (
        low: values.element(ofRank: outer),
        high: values.element(ofRank: values.count - 1 - outer)
      )
    }
    let low = SIMD3(sides[0].low, sides[1].low, sides[2].low)
    let high = SIMD3(sides[0].high, sides[1].high, sides[2].high)
    let inside = sample.count { index in
      let point = cloud.positions[index]
      return (0..<3).allSatisfy { point[$0] >= low[$0] && point[$0] <= high[$0] }
    }
    let size = SIMD3<Double>(high - low)
    let volume = size.x * size.y * size.z
    let points = Double(inside) / Double(sample.count) * Double(cloud.count)
    return volume > 0 ? points / volume : nil
  }

  /// Records the metrics, and logs them as one sentence.
  private func report(_ values: Values, _ notes: StageNotes) {
    notes.record("sparsePoints", Double(values.sparsePoints))
    notes.record("pointsPerSparsePoint", values.pointsPerSparsePoint)
    notes.record("sparseCoverage", values.sparseCoverage)
    var parts = [
      "\(values.points) points, \(Int(values.pointsPerSparsePoint.rounded())) for each sparse point"
    ]
    if let ratio = notes.counts["acceptedPixelRatio"] {
      parts.append("\(percent(ratio)) of the views' pixels measured")
    }
    parts.append("\(percent(values.sparseCoverage)) of the sparse points covered")
    if let density = values.pointsPerCubicMeter {
      notes.record("pointsPerCubicMeter", density)
      parts.append(String(format: "%.3g points/m³", density))
    }
    notes.log(parts.joined(separator: "; ") + ".")
  }

  private func percent(_ ratio: Double) -> String { String(format: "%.0f %%", 100 * ratio) }
}

/// A uniform grid over sparse points that finds those near a dense point. Faster to build than a
/// k-d tree of the dense points.
private struct PointGrid: Sendable {
  private let sparsePositions: [SIMD3<Float>]
  private let inverseCell: Float
  private var cells: [SIMD3<Int32>: [Int32]] = [:]

  /// Twice `reach` and a margin for rounding. Chosen.
  private static let cellReaches: Float = 2.01

  /// Inserts each point into the cells within reach, which are in the same eight.
  init(_ sparsePositions: [SIMD3<Float>], reach: Float) {
    self.sparsePositions = sparsePositions
    inverseCell = 1 / max(Self.cellReaches * reach, .leastNormalMagnitude)
    for (index, position) in sparsePositions.enumerated() {
      guard let own = cell(of: position) else { continue }
      // The neighbors on the sides of the cell that the point is nearer to.
      let inside = position * inverseCell - SIMD3<Float>(own)
      let toNeighbor = SIMD3<Int32>(repeating: -1).replacing(with: 1, where: inside .>= 0.5)
      for corner in 0..<8 {
        let step = SIMD3(Int32(corner & 1), Int32(corner >> 1 & 1), Int32(corner >> 2))
        cells[own &+ step &* toNeighbor, default: []].append(Int32(index))
      }
    }
  }

  /// The numbers of the points near dense points, within a `distance` of each of at most `reach`.
  func points(
    near dense: Range<Int>, of cloud: PointCloud, within distance: (Int) -> Float
  ) -> [Int] {
    var isNear = [Bool](repeating: false, count: sparsePositions.count)
    // Dense points that follow each other are often in one cell.
    var last: SIMD3<Int32>?
    var candidates: [Int32] = []
    for point in dense {
      let position = cloud.positions[point]
      guard let cell = cell(of: position) else { continue }
      if cell != last { (last, candidates) = (cell, cells[cell] ?? []) }
      let limit = distance(point)
      for index in candidates where !isNear[Int(index)] {
        let offset = sparsePositions[Int(index)] - position
        isNear[Int(index)] = (offset * offset).sum() <= limit * limit
      }
    }
    return isNear.indices.filter { isNear[$0] }
  }

  /// Nil if the point isn't finite or its cell index would overflow.
  private func cell(of point: SIMD3<Float>) -> SIMD3<Int32>? {
    let scaled = (point * inverseCell).rounded(.down)
    guard (0..<3).allSatisfy({ abs(scaled[$0]) < 1e9 }) else { return nil }
    return SIMD3<Int32>(scaled)
  }
}

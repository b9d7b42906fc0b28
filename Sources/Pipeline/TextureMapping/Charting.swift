import Foundation
import Kernels
import SceneModel

/// Segments the surface into charts of similarly oriented triangles, and projects each onto a
/// plane.
///
/// Colors are sampled in space, so charts need not follow the choice of photos: a few large charts
/// of uniform resolution pack better than one per photo patch.
struct Charting: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var clustering = ChartClustering()
    /// Resolution of charts that no photo sees, relative to the typical chart. Chosen.
    var unseenDensity: Float = 0.3
    /// Bounds of a chart's resolution relative to the typical chart. Chosen.
    var densityRange: ClosedRange<Float> = 0.3...2
    /// Number of rotations within a quarter turn that are tested for the smallest bounding
    /// rectangle. Chosen: steps of 3°.
    var rotations = 30
  }

  var options = Options()

  /// `labels` holds the photo chosen for each triangle, −1 for none.
  func run(
    _ mesh: Mesh, rated: RatedViews, labels: [Int32], _ context: StageContext
  ) throws -> ChartMap {
    let (charts, axes) = try options.clustering.run(mesh, context.control)
    var result = ChartMap(
      charts: charts, corners: Array(repeating: .zero, count: 3 * charts.count),
      densities: densities(mesh, rated, labels, charts, count: axes.count))
    var facesByChart = [[Int]](repeating: [], count: axes.count)
    for (face, chart) in charts.enumerated() { facesByChart[Int(chart)].append(face) }
    for (chart, faces) in facesByChart.enumerated() {
      if chart % 64 == 0 { try context.control.step(1) }
      flatten(faces, of: mesh, along: axes[chart], into: &result.corners)
    }
    context.notes.record("charts", Double(axes.count))
    return result
  }

  /// Projects triangles along the axis, rotated to a small bounding rectangle.
  private func flatten(
    _ faces: [Int], of mesh: Mesh, along axis: SIMD3<Float>, into corners: inout [SIMD2<Float>]
  ) {
    let helper: SIMD3<Float> = abs(axis.y) < 0.9 ? [0, 1, 0] : [1, 0, 0]
    let u = helper.cross(axis).normalized
    let v = axis.cross(u)
    for face in faces {
      for (corner, vertex) in mesh.triangles[face].vertices.enumerated() {
        let position = mesh.positions[vertex]
        corners[3 * face + corner] = [position.dot(u), position.dot(v)]
      }
    }
    guard faces.count > 2 else { return }
    let points = faces.flatMap { [corners[3 * $0], corners[3 * $0 + 1], corners[3 * $0 + 2]] }
    let turn = smallestBoxRotation(of: points)
    for face in faces {
      for index in 3 * face..<3 * face + 3 { corners[index] = Self.rotate(corners[index], turn) }
    }
  }

  /// The tested rotation with the smallest bounding rectangle.
  private func smallestBoxRotation(of points: [SIMD2<Float>]) -> (cos: Float, sin: Float) {
    var best: (area: Float, turn: (cos: Float, sin: Float)) = (.infinity, (1, 0))
    for step in 0..<options.rotations {
      let angle = Float(step) / Float(options.rotations) * Float.pi / 2
      let turn = (cos: cos(angle), sin: sin(angle))
      var (low, high) = (Self.rotate(points[0], turn), Self.rotate(points[0], turn))
      for point in points {
        let p = Self.rotate(point, turn)
        low = pointwiseMin(low, p)
        high = pointwiseMax(high, p)
      }
      let area = (high.x - low.x) * (high.y - low.y)
      if area < best.area { best = (area, turn) }
    }
    return best.turn
  }

  private static func rotate(
    _ p: SIMD2<Float>, _ turn: (cos: Float, sin: Float)
  ) -> SIMD2<Float> {
    [turn.cos * p.x - turn.sin * p.y, turn.sin * p.x + turn.cos * p.y]
  }

  /// The area-weighted resolution of the chosen photos by chart, in photo pixels per world unit.
  private func densities(
    _ mesh: Mesh, _ rated: RatedViews, _ labels: [Int32], _ charts: [Int32], count: Int
  ) -> [Float] {
    let areas = mesh.triangleAreas()
    var sums = [Float](repeating: 0, count: count)
    var seenAreas = [Float](repeating: 0, count: count)
    for face in charts.indices where labels[face] >= 0 && areas[face] > 0 {
      guard let entry = rated.view(labels[face], of: face) else { continue }
      // Foreshortening reduces the resolution in one direction only.
      sums[Int(charts[face])] +=
        (entry.area / (areas[face] * entry.cosine)).squareRoot()
        * areas[face]
      seenAreas[Int(charts[face])] += areas[face]
    }
    let total = seenAreas.reduce(0, +)
    let typical = total > 0 ? sums.reduce(0, +) / total : 1
    return (0..<count).map { chart in
      guard seenAreas[chart] > 0 else { return typical * options.unseenDensity }
      let density = sums[chart] / seenAreas[chart]
      return min(
        max(density, typical * options.densityRange.lowerBound),
        typical * options.densityRange.upperBound)
    }
  }
}

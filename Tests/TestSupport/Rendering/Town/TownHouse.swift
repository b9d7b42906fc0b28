import SceneModel
import SceneRendering

/// A facade of a `GrowthTown` with windows, as a mesh and a texture of its own.
struct TownHouse {
  /// How deep windows are, in meters. Chosen.
  private static let recess = 0.25

  private let facade: GrowthTown.Facade
  private let height: Double
  /// Where the columns of windows, and of walls between them, begin.
  private let columns: [Double]
  private let rows: [Double]

  init(_ facade: GrowthTown.Facade, _ random: inout SeededGenerator) {
    self.facade = facade
    height = GrowthTown.height * (0.7 + 0.6 * random.uniform())
    columns = Self.edges(facade.width, spacing: 2.2 + 1.4 * random.uniform(), &random)
    rows = Self.edges(height, spacing: 2.6 + 0.8 * random.uniform(), &random)
  }

  /// Alternating beginnings of walls and windows from 0 to `length`, each window with a width of
  /// its own.
  private static func edges(
    _ length: Double, spacing: Double, _ random: inout SeededGenerator
  ) -> [Double] {
    let count = max(1, Int(length / spacing))
    let step = length / Double(count)
    let windows = (0..<count).flatMap { index in
      let width = step * (0.3 + 0.25 * random.uniform())
      let start = (Double(index) + 0.5) * step - width / 2 + 0.1 * step * random.uniform()
      return [start, start + width]
    }
    return [0] + windows + [length]
  }

  /// Walls, panes and reveals.
  var mesh: Mesh {
    var mesh = Mesh()
    for (row, rise) in zip(rows, rows.dropFirst()).enumerated() {
      for (column, span) in zip(columns, columns.dropFirst()).enumerated() {
        let isWindow = row % 2 == 1 && column % 2 == 1
        add(span, rise, depth: isWindow ? Self.recess : 0, to: &mesh)
        if isWindow { addReveals(span, rise, to: &mesh) }
      }
    }
    return mesh
  }

  private func point(_ along: Double, _ up: Double, _ depth: Double) -> SIMD3<Double> {
    facade.corner + facade.along * along + [0, up, 0] - facade.normal * depth
  }

  private func add(
    _ span: (Double, Double), _ rise: (Double, Double), depth: Double, to mesh: inout Mesh
  ) {
    add(
      [
        point(span.0, rise.0, depth), point(span.1, rise.0, depth), point(span.1, rise.1, depth),
        point(span.0, rise.1, depth),
      ], facing: facade.normal, to: &mesh)
  }

  private func addReveals(
    _ span: (Double, Double), _ rise: (Double, Double), to mesh: inout Mesh
  ) {
    let depths = (0.0, Self.recess)
    for (up, normal) in [(rise.0, SIMD3(0, 1.0, 0)), (rise.1, SIMD3(0, -1.0, 0))] {
      add(
        [
          point(span.0, up, depths.0), point(span.1, up, depths.0), point(span.1, up, depths.1),
          point(span.0, up, depths.1),
        ], facing: normal, to: &mesh)
    }
    for (along, normal) in [(span.0, facade.along), (span.1, -facade.along)] {
      add(
        [
          point(along, rise.0, depths.0), point(along, rise.1, depths.0),
          point(along, rise.1, depths.1), point(along, rise.0, depths.1),
        ], facing: normal, to: &mesh)
    }
  }

  /// Adds a quadrilateral, counterclockwise seen from where its normal points to.
  private func add(
    _ corners: [SIMD3<Double>], facing normal: SIMD3<Double>, to mesh: inout Mesh
  ) {
    let turn = (corners[1] - corners[0]).cross(corners[2] - corners[0])
    let ordered = turn.dot(normal) > 0 ? corners : corners.reversed()
    let first = UInt32(mesh.positions.count)
    mesh.positions += ordered.map { SIMD3<Float>($0) }
    mesh.normals += Array(repeating: SIMD3<Float>(normal), count: 4)
    mesh.triangles += [
      Triangle(first, first + 1, first + 2), Triangle(first, first + 2, first + 3),
    ]
  }
}

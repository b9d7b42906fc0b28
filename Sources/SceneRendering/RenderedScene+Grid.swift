import SceneModel

extension RenderedScene {
  /// A mesh over the unit square, u to the right and v up, counter-clockwise from outside; closed
  /// in u if `isClosed`. Normals are finite differences of the positions.
  package static func grid(
    columns: Int, rows: Int, isClosed: Bool, _ position: (Double, Double) -> SIMD3<Double>
  ) -> Mesh {
    var mesh = Mesh()
    let span = Double(isClosed ? columns : columns - 1)
    for row in 0..<rows {
      for column in 0..<columns {
        let (u, v) = (Double(column) / span, Double(row) / Double(rows - 1))
        let (du, dv) = (0.25 / span, 0.25 / Double(rows - 1))
        let right = position(u + du, v) - position(u - du, v)
        let up = position(u, min(1, v + dv)) - position(u, max(0, v - dv))
        let normal = right.cross(up).normalized
        mesh.positions.append(SIMD3<Float>(position(u, v)))
        mesh.normals.append(
          normal == .zero || !normal.x.isFinite ? [0, 1, 0] : SIMD3<Float>(normal))
      }
    }
    func index(_ row: Int, _ column: Int) -> UInt32 { UInt32(row * columns + column % columns) }
    for row in 0..<rows - 1 {
      for column in 0..<(isClosed ? columns : columns - 1) {
        let (a, b) = (index(row, column), index(row, column + 1))
        let (c, d) = (index(row + 1, column + 1), index(row + 1, column))
        mesh.triangles.append(Triangle(a, b, c))
        // The top row of a closed grid is a single point.
        if !(isClosed && row == rows - 2) { mesh.triangles.append(Triangle(a, c, d)) }
      }
    }
    return mesh
  }
}

/// A row-major 3×3 matrix of doubles.
package struct Matrix3: Hashable, Codable, Sendable {
  package var row0: SIMD3<Double>
  package var row1: SIMD3<Double>
  package var row2: SIMD3<Double>

  package init(rows row0: SIMD3<Double>, _ row1: SIMD3<Double>, _ row2: SIMD3<Double>) {
    (self.row0, self.row1, self.row2) = (row0, row1, row2)
  }

  package static let identity = Matrix3(rows: [1, 0, 0], [0, 1, 0], [0, 0, 1])

  package var transpose: Matrix3 {
    Matrix3(
      rows: [row0.x, row1.x, row2.x], [row0.y, row1.y, row2.y], [row0.z, row1.z, row2.z])
  }

  package var determinant: Double { row0.dot(row1.cross(row2)) }

  package static func * (m: Matrix3, v: SIMD3<Double>) -> SIMD3<Double> {
    [m.row0.dot(v), m.row1.dot(v), m.row2.dot(v)]
  }

  package static func * (a: Matrix3, b: Matrix3) -> Matrix3 {
    let columns = b.transpose
    func row(_ r: SIMD3<Double>) -> SIMD3<Double> {
      [r.dot(columns.row0), r.dot(columns.row1), r.dot(columns.row2)]
    }
    return Matrix3(rows: row(a.row0), row(a.row1), row(a.row2))
  }

  /// The mean of (p − `center`)(p − `center`)ᵀ over the points, which must not be empty; with their
  /// mean as center, their covariance.
  package init(scatterOf points: [SIMD3<Double>], about center: SIMD3<Double>) {
    var rows = [SIMD3<Double>](repeating: .zero, count: 3)
    for point in points {
      let d = point - center
      for axis in 0..<3 { rows[axis] += d[axis] * d / Double(points.count) }
    }
    self.init(rows: rows[0], rows[1], rows[2])
  }

  /// The solution x of `self · x = right` by Cramer's rule; nil for a singular matrix.
  package func solution(of right: SIMD3<Double>) -> SIMD3<Double>? {
    let columns = transpose
    let determinant = determinant
    guard determinant.isFinite, abs(determinant) > .leastNormalMagnitude else { return nil }
    func replaced(_ index: Int) -> Double {
      var c = [columns.row0, columns.row1, columns.row2]
      c[index] = right
      return c[0].dot(c[1].cross(c[2]))
    }
    let solution = SIMD3(replaced(0), replaced(1), replaced(2)) / determinant
    return solution.isFinite ? solution : nil
  }

  /// The nine elements, row by row.
  package var elements: [Double] {
    [row0.x, row0.y, row0.z, row1.x, row1.y, row1.z, row2.x, row2.y, row2.z]
  }
}

/// Eigenvalues and unit eigenvectors of a small symmetric matrix (cyclic Jacobi method; Golub and
/// Van Loan, "Matrix Computations").
package struct SymmetricEigen: Sendable {
  /// The eigenvalues, unordered.
  package private(set) var values: [Double]
  /// `vectors[i]` belongs to `values[i]`.
  package private(set) var vectors: [[Double]]

  /// Maximum number of sweeps. Chosen: five to ten suffice.
  private static let maximumSweeps = 50
  /// Off-diagonal elements up to this value count as zero. Limit: near the smallest double.
  private static let tolerance = 1e-300

  /// Decomposes a matrix given by rows.
  package init(_ matrix: [[Double]]) {
    var a = matrix
    let n = matrix.count
    var v = (0..<n).map { row in (0..<n).map { $0 == row ? 1.0 : 0.0 } }
    for _ in 0..<Self.maximumSweeps {
      var change = 0.0
      for p in 0..<n {
        for q in (p + 1)..<max(p + 1, n) where a[p][q] != 0 {
          change = max(change, abs(a[p][q]))
          Self.rotate(&a, &v, p, q)
        }
      }
      if change < Self.tolerance { break }
    }
    values = (0..<n).map { a[$0][$0] }
    vectors = (0..<n).map { column in (0..<n).map { v[$0][column] } }
  }

  /// Applies the Jacobi rotation that zeroes the element at row `p`, column `q`.
  private static func rotate(_ a: inout [[Double]], _ v: inout [[Double]], _ p: Int, _ q: Int) {
    let theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
    let t = (theta < 0 ? -1 : 1) / (abs(theta) + (theta * theta + 1).squareRoot())
    let c = 1 / (t * t + 1).squareRoot()
    let s = t * c
    for k in a.indices {
      (a[k][p], a[k][q]) = (c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q])
    }
    for k in a.indices {
      (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k])
    }
    for k in v.indices {
      (v[k][p], v[k][q]) = (c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q])
    }
  }
}

extension Matrix3 {
  /// The eigenvalues of a symmetric matrix in ascending order, with unit eigenvectors.
  package var symmetricEigen: (values: [Double], vectors: [SIMD3<Double>]) {
    let eigen = SymmetricEigen([row0, row1, row2].map { [$0.x, $0.y, $0.z] })
    let order = [0, 1, 2].sorted { (eigen.values[$0], $0) < (eigen.values[$1], $1) }
    return (order.map { eigen.values[$0] }, order.map { SIMD3(eigen.vectors[$0]) })
  }
}

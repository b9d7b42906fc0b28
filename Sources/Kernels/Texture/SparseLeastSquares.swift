import CKernels

/// Sparse linear least squares with three right-hand sides.
///
/// Accumulates the normal equations; solves them by conjugate gradients, starting from zero.
package struct SparseLeastSquares: Sendable {
  /// Number of unknowns, each a vector of three numbers.
  package let unknownCount: Int
  private var rows: [UInt32] = []
  private var columns: [UInt32] = []
  private var entries: [Double] = []
  private var diagonal: [Double]
  private var rightSides: [SIMD3<Double>]

  package init(unknownCount: Int) {
    self.unknownCount = unknownCount
    diagonal = Array(repeating: 0, count: unknownCount)
    rightSides = Array(repeating: .zero, count: unknownCount)
  }

  /// Adds `weight · |x[i] − value|²`.
  package mutating func add(_ i: Int, value: SIMD3<Double>, weight: Double) {
    diagonal[i] += weight
    rightSides[i] += weight * value
  }

  /// Adds `weight · |x[i] − x[j] − value|²`.
  package mutating func add(
    _ i: Int, minus j: Int, value: SIMD3<Double> = .zero, weight: Double
  ) {
    guard i != j else { return }
    diagonal[i] += weight
    diagonal[j] += weight
    rightSides[i] += weight * value
    rightSides[j] -= weight * value
    rows.append(UInt32(max(i, j)))
    columns.append(UInt32(min(i, j)))
    entries.append(-weight)
  }

  /// The unknowns. Every connected component needs at least one `add` with an absolute value.
  package func solve(
    tolerance: Double = 1e-5, iterations: Int = 2000, _ control: KernelControl
  ) throws -> [SIMD3<Double>] {
    var values = rightSides.flatMap { [$0.x, $0.y, $0.z] }
    let indices = 0..<UInt32(unknownCount)
    let (allRows, allColumns) = (KernelArray(rows + indices), KernelArray(columns + indices))
    // A tiny weight keeps unknowns without equations at zero.
    let allEntries = KernelArray(entries + diagonal.map { max($0, 1e-12) })
    var options = ck_conjugate_gradient_options(
      tolerance: tolerance, maximum_iterations: iterations)
    try withExtendedLifetime((allRows, allColumns, allEntries)) {
      var matrix = ck_sparse_matrix(
        size: unknownCount, entry_count: allEntries.count, rows: allRows.base,
        columns: allColumns.base, entries: allEntries.base)
      try withKernel(control) { ck_solve_sparse(&matrix, 3, &options, $0, &values) }
    }
    return (0..<unknownCount).map {
      SIMD3(values[3 * $0], values[3 * $0 + 1], values[3 * $0 + 2])
    }
  }
}

/// The normal equations of a linear least-squares problem with a few unknowns.
struct NormalEquations {
  private let unknowns: Int
  private var matrix: [[Double]]
  private var right: [Double]

  init(unknowns: Int) {
    self.unknowns = unknowns
    matrix = [[Double]](repeating: [Double](repeating: 0, count: unknowns), count: unknowns)
    right = [Double](repeating: 0, count: unknowns)
  }

  /// Adds the equation `row · x = value`; numbers beyond the unknowns are ignored.
  mutating func add(_ row: [Double], _ value: Double) {
    for i in 0..<unknowns {
      for j in 0...i { matrix[i][j] += row[i] * row[j] }
      right[i] += row[i] * value
    }
  }

  /// The solution by Cholesky's decomposition; nil if the unknowns are not determined.
  var solution: [Double]? {
    var (l, x) = (matrix, right)
    for i in 0..<unknowns {
      for j in 0...i {
        let sum = (0..<j).reduce(l[i][j]) { $0 - l[i][$1] * l[j][$1] }
        if i == j {
          // Relative to the diagonal before elimination: what is left is rounding.
          guard sum > 1e-12 * matrix[i][i] else { return nil }
          l[i][i] = sum.squareRoot()
        } else {
          l[i][j] = sum / l[j][j]
        }
      }
      x[i] = (0..<i).reduce(x[i]) { $0 - l[i][$1] * x[$1] } / l[i][i]
    }
    for i in (0..<unknowns).reversed() {
      x[i] = (i + 1..<unknowns).reduce(x[i]) { $0 - l[$1][i] * x[$1] } / l[i][i]
    }
    return x
  }
}

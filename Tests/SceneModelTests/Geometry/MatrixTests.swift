import SceneModel
import Testing

@Suite struct MatrixTests {
  private let m = Matrix3(rows: [1, 2, 3], [4, 5, 6], [7, 8, 10])

  @Test func elementsAreRowByRow() {
    #expect(m.elements == [1, 2, 3, 4, 5, 6, 7, 8, 10])
    #expect(m.transpose.elements == [1, 4, 7, 2, 5, 8, 3, 6, 10])
    #expect(m.transpose.transpose == m)
  }

  @Test func productsAreExact() {
    #expect(m * SIMD3(1, 10, 100) == [321, 654, 1087])
    let n = Matrix3(rows: [0, 1, 0], [0, 0, 1], [1, 0, 0])
    #expect((m * n).elements == [3, 1, 2, 6, 4, 5, 10, 7, 8])
    #expect(m * .identity == m && .identity * m == m)
  }

  @Test func determinantIsMultiplicativeAndVanishesForDependentRows() {
    #expect(m.determinant == -3 && m.transpose.determinant == -3)
    #expect(Matrix3(rows: [1, 2, 3], [2, 4, 6], [0, 1, 5]).determinant == 0)
    var random = SplitMix64(seed: 10)
    for _ in 0..<50 {
      let (a, b) = (
        Matrix3(rows: random.vector(), random.vector(), random.vector()),
        Matrix3(rows: random.vector(), random.vector(), random.vector())
      )
      #expect(abs((a * b).determinant - a.determinant * b.determinant) < 1e-13)
    }
  }
}

@Suite struct SymmetricEigenTests {
  @Test func diagonalMatricesAreTheirEigenvalues() {
    let eigen = Matrix3(rows: [3, 0, 0], [0, -1, 0], [0, 0, 2]).symmetricEigen
    #expect(eigen.values == [-1, 2, 3])
    #expect(eigen.vectors == [[0, 1, 0], [0, 0, 1], [1, 0, 0]])
  }

  @Test func knownEigenvaluesAreFound() {
    let eigen = Matrix3(rows: [2, 1, 0], [1, 2, 0], [0, 0, 5]).symmetricEigen
    for (value, expected) in zip(eigen.values, [1.0, 3, 5]) {
      #expect(abs(value - expected) < 1e-14)
    }
    let half = 0.5.squareRoot()
    #expect(abs(abs(eigen.vectors[0].dot([half, -half, 0])) - 1) < 1e-14)
  }

  @Test(arguments: [1, 2, 3, 4, 6, 9]) func vectorsDiagonalizeTheMatrix(size: Int) {
    var random = SplitMix64(seed: UInt64(size))
    var matrix = [[Double]](repeating: [Double](repeating: 0, count: size), count: size)
    for row in 0..<size {
      for column in row..<size {
        matrix[row][column] = random.number(3)
        matrix[column][row] = matrix[row][column]
      }
    }
    let eigen = SymmetricEigen(matrix)
    for (value, vector) in zip(eigen.values, eigen.vectors) {
      for row in 0..<size {
        let product = zip(matrix[row], vector).reduce(0) { $0 + $1.0 * $1.1 }
        #expect(abs(product - value * vector[row]) < 1e-12)
      }
    }
    for a in 0..<size {
      for b in 0..<size {
        let product = zip(eigen.vectors[a], eigen.vectors[b]).reduce(0) { $0 + $1.0 * $1.1 }
        #expect(abs(product - (a == b ? 1 : 0)) < 1e-12)
      }
    }
    let trace = (0..<size).reduce(0) { $0 + matrix[$1][$1] }
    #expect(abs(eigen.values.reduce(0, +) - trace) < 1e-12)
  }

  @Test func repeatedEigenvaluesHaveOrthogonalVectors() {
    let eigen = SymmetricEigen([[2, 0, 0], [0, 2, 0], [0, 0, 2]])
    #expect(eigen.values == [2, 2, 2] && eigen.vectors == [[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    #expect(SymmetricEigen([]).values.isEmpty)
  }
}

import Testing

@testable import Evaluation

@Suite struct NormalEquationsTests {
  @Test func consistentEquationsAreSolvedExactly() throws {
    var equations = NormalEquations(unknowns: 3)
    for row in [[1, 2, 3], [0, 1, -1], [4, 0, 1], [1, 1, 1]] as [[Double]] {
      equations.add(row, row[0] * 2 - row[1] + row[2] * 0.5)
    }
    let x = try #require(equations.solution)
    for (found, wanted) in zip(x, [2, -1, 0.5]) { #expect(abs(found - wanted) < 1e-12) }
  }

  @Test func undeterminedUnknownsHaveNoSolution() {
    var equations = NormalEquations(unknowns: 2)
    equations.add([1, 1], 3)
    equations.add([2, 2], 6)
    #expect(equations.solution == nil)
  }
}

import SceneModel
import Testing

@Suite struct VectorTests {
  @Test func axesMultiplyByTheRightHandRule() {
    let (x, y, z) = (SIMD3<Double>(1, 0, 0), SIMD3<Double>(0, 1, 0), SIMD3<Double>(0, 0, 1))
    #expect(x.cross(y) == z && y.cross(z) == x && z.cross(x) == y && y.cross(x) == -z)
    #expect(x.dot(x) == 1 && x.dot(y) == 0)
    #expect(SIMD3<Double>(1, 2, 3).dot([4, -5, 6]) == 12)
    #expect(SIMD3<Double>(1, 2, 3).cross([4, 5, 6]) == [-3, 6, -3])
  }

  @Test func crossProductIsPerpendicularAndHasTheArea() {
    var random = SplitMix64(seed: 2)
    for _ in 0..<100 {
      let (a, b) = (random.vector(5), random.vector(5))
      let c = a.cross(b)
      #expect(abs(c.dot(a)) < 1e-12 && abs(c.dot(b)) < 1e-12)
      // Lagrange's identity.
      let area = a.squaredLength * b.squaredLength - a.dot(b) * a.dot(b)
      #expect(abs(c.squaredLength - area) < 1e-10)
    }
  }

  @Test func lengthsAreEuclidean() {
    #expect(SIMD3<Float>(2, -3, 6).length == 7 && SIMD3<Float>(2, -3, 6).squaredLength == 49)
    #expect(SIMD2<Double>(3, -4).length == 5 && SIMD2<Double>(3, -4).squaredLength == 25)
    #expect(SIMD2<Double>(3, -4).dot([2, 1]) == 2)
  }

  @Test func normalizationKeepsZero() {
    #expect(SIMD3<Double>(0, 0, -5).normalized == [0, 0, -1])
    #expect(SIMD3<Double>.zero.normalized == .zero)
  }
}

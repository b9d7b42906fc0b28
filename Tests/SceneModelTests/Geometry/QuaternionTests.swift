import Foundation
import SceneModel
import Testing

@Suite struct QuaternionTests {
  @Test func quarterTurnsFollowTheRightHandRule() {
    let half = 0.5.squareRoot()
    let q = Quaternion(angle: .pi / 2, axis: [0, 0, 3])
    #expect(abs(q.z - half) < 1e-15 && abs(q.w - half) < 1e-15 && q.x == 0 && q.y == 0)
    #expect((q * SIMD3(1, 0, 0) - [0, 1, 0]).length < 1e-15)
    #expect((q * SIMD3(0, 1, 0) - [-1, 0, 0]).length < 1e-15)
    #expect(q * SIMD3(0, 0, 2) == [0, 0, 2])
  }

  @Test func productRotatesByTheRightFactorFirst() {
    var random = SplitMix64(seed: 3)
    for _ in 0..<100 {
      let (a, b, v) = (random.rotation(), random.rotation(), random.vector())
      #expect(((a * b) * v - a * (b * v)).length < 1e-14)
      #expect(difference((a * b).matrix, a.matrix * b.matrix) < 1e-14)
    }
  }

  @Test func rotationsKeepLengthsAnglesAndHandedness() {
    var random = SplitMix64(seed: 4)
    for _ in 0..<100 {
      let (q, a, b) = (random.rotation(), random.vector(), random.vector())
      #expect(abs((q * a).dot(q * b) - a.dot(b)) < 1e-14)
      #expect(((q * a).cross(q * b) - q * a.cross(b)).length < 1e-14)
    }
  }

  @Test func conjugateIsTheInverse() {
    var random = SplitMix64(seed: 5)
    for _ in 0..<100 {
      let (q, v) = (random.rotation(), random.vector())
      #expect((q.conjugate * (q * v) - v).length < 1e-14)
      #expect(difference(q.conjugate.matrix, q.matrix.transpose) < 1e-15)
    }
  }

  @Test func matricesAreOrthogonal() {
    var random = SplitMix64(seed: 6)
    for _ in 0..<100 {
      let m = random.rotation().matrix
      #expect(difference(m * m.transpose, .identity) < 1e-14)
      #expect(abs(m.determinant - 1) < 1e-14)
    }
  }

  /// Shepperd's method has a branch for each component that may be the largest.
  @Test(arguments: [
    SIMD4<Double>(0.1, 0.2, 0.3, 0.9), [0.9, 0.2, -0.3, 0.1], [0.2, 0.9, 0.1, -0.3],
    [-0.1, 0.3, 0.9, 0.2], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1],
    [0.5, 0.5, 0.5, 0.5], [-0.5, 0.5, -0.5, 0.5],
  ]) func everyBranchOfTheMatrixConversionIsExact(components: SIMD4<Double>) {
    let q = Quaternion(x: components.x, y: components.y, z: components.z, w: components.w)
      .normalized
    let back = Quaternion(q.matrix)
    let product = q.x * back.x + q.y * back.y + q.z * back.z + q.w * back.w
    #expect(abs(abs(product) - 1) < 1e-14)
    #expect(difference(back.matrix, q.matrix) < 1e-14)
  }

  @Test func angleIsTheSmallerOne() {
    let axis = SIMD3<Double>(1, -2, 0.5)
    for angle in stride(from: 0.0, through: 3.1, by: 0.1) {
      #expect(abs(Quaternion(angle: angle, axis: axis).angle - angle) < 1e-12)
      #expect(abs(Quaternion(angle: 2 * .pi - angle, axis: axis).angle - angle) < 1e-12)
      #expect(abs(Quaternion(angle: -angle, axis: axis).angle - angle) < 1e-12)
    }
    #expect(Quaternion.identity.angle == 0)
  }

  @Test func normalizationScalesAndZeroBecomesTheIdentity() {
    #expect(Quaternion(x: 0, y: 3, z: 0, w: 4).normalized == Quaternion(x: 0, y: 0.6, z: 0, w: 0.8))
    #expect(Quaternion(x: 0, y: 0, z: 0, w: 0).normalized == .identity)
  }
}

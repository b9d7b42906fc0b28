import Foundation
import Testing
import simd

@Suite struct SimdFunctionTests {
  @Test func roundingWorksByComponent() {
    let x = SIMD4<Double>(-1.5, -0.25, 0.25, 1.5)
    #expect(floor(x) == [-2, -1, 0, 1] && ceil(x) == [-1, 0, 1, 2] && trunc(x) == [-1, 0, 0, 1])
    #expect(fract(x) == [0.5, 0.75, 0.25, 0.5] && simd_fract(x) == fract(x))
    #expect(sign(SIMD3<Float>(-3, 0, 2)) == [-1, 0, 1])
  }

  @Test func rootsAndReciprocalsWorkByComponent() {
    let x = SIMD2<Float>(4, 16)
    #expect(sqrt(x) == [2, 4] && rsqrt(x) == [0.5, 0.25] && recip(x) == [0.25, 0.0625])
    #expect(simd_recip(x) == recip(x) && simd_rsqrt(x) == rsqrt(x))
  }

  @Test func stepsSwitchAtTheEdge() {
    #expect(step(SIMD3<Float>(0, 1, 2), edge: [1, 1, 1]) == [0, 1, 1])
    #expect(simd_step(SIMD3<Float>(1, 1, 1), [0, 1, 2]) == [0, 1, 1])
  }

  @Test func smoothStepsAreHermite() {
    let (zero, one) = (SIMD4<Double>(repeating: 0), SIMD4<Double>(repeating: 1))
    let x = SIMD4<Double>(-1, 0.25, 0.5, 7)
    #expect(smoothstep(x, edge0: zero, edge1: one) == [0, 0.15625, 0.5, 1])
    #expect(simd_smoothstep(zero, one, x) == smoothstep(x, edge0: zero, edge1: one))
    #expect(smoothstep(SIMD2<Float>(3, 4), edge0: [2, 2], edge1: [4, 4]) == [0.5, 1])
  }

  @Test func normsAndDistancesFollowTheirDefinitions() {
    let (x, y) = (SIMD3<Double>(1, -2, 2), SIMD3<Double>(1, 1, 6))
    #expect(norm_one(x) == 5 && norm_inf(x) == 2 && length(x) == 3 && length_squared(x) == 9)
    #expect(distance(x, y) == 5 && distance_squared(x, y) == 25)
    #expect(simd_fast_distance(x, y) == 5 && simd_precise_length(x) == 3)
    #expect(reduce_add(x) == 1 && reduce_min(x) == -2 && reduce_max(x) == 2)
  }

  @Test func projectionIsOntoTheSecondVector() {
    #expect(project(SIMD2<Double>(3, 4), [2, 0]) == [3, 0])
    #expect(simd_project(SIMD2<Double>(1, 1), [0, -4]) == [0, 1])
  }

  @Test func refractionFollowsSnell() {
    let incident = normalize(SIMD2<Double>(1, -1))
    let refracted = refract(incident, n: [0, 1], eta: 1 / 1.5)
    #expect(abs(length(refracted) - 1) < 1e-12)
    #expect(abs(1.5 * refracted.x - incident.x) < 1e-12 && refracted.y < 0)
    // Total reflection.
    #expect(refract(normalize(SIMD2<Double>(1, -0.1)), n: [0, 1], eta: 1.5) == [0, 0])
    #expect(simd_refract(incident, [0, 1], 1) == refract(incident, n: [0, 1], eta: 1))
  }

  @Test func mixingTakesAShareForEachComponent() {
    let (x, y) = (SIMD2<Double>(0, 10), SIMD2<Double>(4, 20))
    #expect(mix(x, y, t: [0.25, 0.5]) == [1, 15] && simd_mix(x, y, [1, 0]) == [4, 10])
    #expect(clamp(y, min: [5, 5], max: [9, 9]) == [5, 9])
  }

  @Test func planarCrossProductIsAlongZ() {
    #expect(cross(SIMD2<Double>(1, 2), [3, 4]) == [0, 0, -2])
  }

  @Test func doubleQuaternionsAgreeWithTheirMatrices() {
    let q = simd_quatd(angle: 2.1, axis: normalize([1, 2, -0.5]))
    let p = simd_quatd(from: [1, 0, 0], to: [0, 0, 1])
    let v = SIMD3<Double>(0.3, -4, 2.5)
    #expect(length(q.act(v) - simd_double3x3(q) * v) < 1e-14)
    #expect(length((p * q).act(v) - p.act(q.act(v))) < 1e-13)
    #expect(length(p.act([1, 0, 0]) - [0, 0, 1]) < 1e-15)
    #expect(
      abs(q.angle - 2.1) < 1e-14 && abs(abs(dot(simd_quatd(simd_double4x4(q)), q)) - 1) < 1e-14)
    #expect((q * q.inverse).real.distance(to: 1).magnitude < 1e-15)
  }

  @Test func longestSlerpTakesTheOtherWay() {
    let (zero, q) = (
      simd_quatd(ix: 0, iy: 0, iz: 0, r: 1), simd_quatd(angle: 1, axis: [0, 0, 1])
    )
    let short = simd_slerp(zero, q, 0.5)
    let long = simd_slerp_longest(zero, q, 0.5)
    #expect(length(short.act([1, 0, 0]) - [cos(0.5), sin(0.5), 0]) < 1e-12)
    #expect(length(long.act([1, 0, 0]) + [cos(0.5), sin(0.5), 0]) < 1e-12)
  }

  @Test func matrixFunctionsAreTheOperators() {
    let m = simd_float4x4(rows: [[2, 0, 1, 0], [-1, 3, 0, 0], [0, 1, 4, 0], [5, 6, 7, 1]])
    let v = SIMD4<Float>(1, 2, 3, 4)
    #expect(matrix_multiply(m, v) == m * v && matrix_transpose(m) == m.transpose)
    #expect(matrix_determinant(m) == m.determinant && matrix_invert(m) == m.inverse)
    #expect(simd_equal(m, m) && !simd_equal(m, m.transpose))
    #expect(simd_linear_combination(2, m, -1, m) == m)
  }
}

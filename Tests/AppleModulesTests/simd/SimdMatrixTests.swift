import Testing
import simd

@Suite struct SimdMatrixTests {
  let a = float3x3([2, 0, 1], [-1, 3, 0.5], [0, 1, 4])
  let b = float4x4([2, 0, 1, 0], [-1, 3, 0.5, 0], [0, 1, 4, 0.25], [5, 6, 7, 1])

  @Test func inverseTimesMatrixIsIdentity() {
    #expect(simd_almost_equal_elements(a.inverse * a, matrix_identity_float3x3, 1e-6))
    #expect(simd_almost_equal_elements(a * simd_inverse(a), matrix_identity_float3x3, 1e-6))
    #expect(simd_almost_equal_elements(b.inverse * b, matrix_identity_float4x4, 1e-5))
    let d = double4x4([2, 0, 1, 0], [-1, 3, 0.5, 0], [0, 1, 4, 0.25], [5, 6, 7, 1])
    #expect(simd_almost_equal_elements(d * d.inverse, matrix_identity_double4x4, 1e-13))
  }

  @Test func determinantsAreExact() {
    #expect(a.determinant == 22)
    #expect(simd_determinant(float4x4(diagonal: [2, 3, 4, 5])) == 120)
    // Swapping two columns changes the sign.
    let swapped = float4x4(b[1], b[0], b[2], b[3])
    #expect(abs(swapped.determinant + b.determinant) < 1e-4)
    #expect(float4x4(b[0], b[0], b[2], b[3]).determinant == 0)
  }

  @Test func columnsRowsAndSubscriptsAgree() {
    let m = float3x3(rows: [[1, 2, 3], [4, 5, 6], [7, 8, 9]])
    #expect(m.columns.1 == [2, 5, 8])
    #expect(m[2, 0] == 3)
    #expect(m.transpose == float3x3([[1, 2, 3], [4, 5, 6], [7, 8, 9]]))
    #expect(m * SIMD3(1, 0, 0) == m[0])
    #expect(SIMD3(1, 0, 0) * m == [1, 2, 3])
    var n = m
    n[1, 2] = -1
    #expect(n != m && n[1] == [2, 5, -1])
    #expect(Set([m, n, m]).count == 2)
    #expect(2 * m - m == m && -m + m == float3x3() && m * 2 == m + m)
  }

  @Test func productAppliesTheRightOneFirst() {
    let v = SIMD3<Float>(0.5, -2, 3)
    let c = float3x3(rows: [[0, 1, 0], [1, 0, 0], [0, 0, 2]])
    #expect(length((a * c) * v - a * (c * v)) < 1e-5)
    #expect(simd_mul(a, v) == a * v)
    #expect(simd_mul(simd_mul(b, b), b[0]) == (b * b) * b[0])
  }

  @Test func printsLikeMacOS() {
    #expect(
      matrix_identity_float3x3.debugDescription
        == "simd_float3x3([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])")
    #expect(float4x4(2).debugDescription.hasPrefix("simd_float4x4([[2.0, 0.0, 0.0, 0.0], "))
  }

  @Test func vectorFunctionsMatchTheirDefinitions() {
    let (x, y) = (SIMD3<Float>(1, 2, 3), SIMD3<Float>(-4, 5, 0.5))
    #expect(dot(x, y) == 7.5 && simd_dot(x, y) == 7.5)
    #expect(cross(SIMD3<Float>(1, 0, 0), [0, 1, 0]) == [0, 0, 1])
    #expect(abs(dot(cross(x, y), x)) < 1e-5 && abs(dot(simd_cross(x, y), y)) < 1e-5)
    #expect(length(SIMD2<Double>(3, 4)) == 5 && simd_length_squared(SIMD2<Double>(3, 4)) == 25)
    #expect(abs(simd_length(normalize(y)) - 1) < 1e-6)
    #expect(distance(x, x + [0, 0, 2]) == 2)
    #expect(abs(y) == [4, 5, 0.5] && min(x, y) == [-4, 2, 0.5] && max(x, y) == [1, 5, 3])
    #expect(clamp(y, min: -1, max: 1) == [-1, 1, 0.5])
    #expect(mix(x, y, t: 0) == x && mix(x, y, t: 1) == y)
    #expect(reflect(SIMD2<Float>(1, -1), n: [0, 1]) == [1, 1])
  }
}

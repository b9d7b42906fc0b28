import Foundation
import Testing
import simd

@Suite struct SimdQuaternionTests {
  let q = simd_quatf(angle: 0.7, axis: normalize(SIMD3(1, -2, 0.5)))

  @Test(arguments: [0.0, 0.3, 1.5, 2.9, .pi, 4.4, 6.1] as [Float])
  func survivesItsMatrix(angle: Float) {
    for axis in [SIMD3<Float>(1, 0, 0), [0, 1, 0], [0, 0, 1], normalize([1, -2, 0.5])] {
      let q = simd_quatf(angle: angle, axis: axis)
      #expect(abs(abs(dot(simd_quatf(float3x3(q)), q)) - 1) < 1e-5)
      #expect(abs(abs(dot(simd_quatf(float4x4(q)), q)) - 1) < 1e-5)
      #expect(abs(float3x3(q).determinant - 1) < 1e-5)
    }
  }

  @Test func actsLikeItsMatrix() {
    let v = SIMD3<Float>(0.3, -4, 2.5)
    #expect(length(q.act(v) - float3x3(q) * v) < 1e-5)
    #expect(length(simd_act(q.inverse, q.act(v)) - v) < 1e-5)
    let quarter = simd_quatf(angle: .pi / 2, axis: [0, 0, 1])
    #expect(length(quarter.act([1, 0, 0]) - [0, 1, 0]) < 1e-6)
  }

  @Test func productAppliesTheRightOneFirst() {
    let p = simd_quatf(ix: 0.5, iy: 0.5, iz: -0.5, r: 0.5)
    let v = SIMD3<Float>(1, 2, 3)
    #expect(length((p * q).act(v) - p.act(q.act(v))) < 1e-5)
    #expect(length((p * q / q).vector - p.vector) < 1e-5)
    #expect(simd_mul(p, q) == p * q)
  }

  @Test(arguments: [SIMD3<Float>(1, 0, 0), [-1, 0, 0], [0, 0, -1], [-0.99995, 0.01, 0]])
  func turnsOneVectorToAnother(to: SIMD3<Float>) {
    let to = normalize(to)
    for from in [SIMD3<Float>(1, 0, 0), [0, 1, 0], [0, 0, 1]] {
      let q = simd_quatf(from: from, to: to)
      #expect(length(q.act(from) - to) < 1e-5)
      #expect(abs(q.length - 1) < 1e-5)
    }
  }

  @Test func angleAndAxisComeBack() {
    #expect(abs(q.angle - 0.7) < 1e-5)
    #expect(length(q.axis - normalize([1, -2, 0.5])) < 1e-5)
    #expect(q.conjugate.imag == -q.imag && q.conjugate.real == q.real)
  }

  @Test func slerpKeepsItsSpeed() {
    let identity = simd_quatf(ix: 0, iy: 0, iz: 0, r: 1)
    for t in stride(from: Float(0), through: 1, by: 0.125) {
      #expect(abs(simd_slerp(identity, q, t).angle - 0.7 * t) < 1e-5)
      // -q is the same rotation; the shorter arc leads there.
      #expect(abs(abs(simd_slerp(identity, -q, t).angle) - 0.7 * t) < 1e-5)
    }
    #expect(simd_slerp(q, q, 0.5) == q.normalized)
  }

  @Test func isCodedAsFourNumbers() throws {
    let q = simd_quatf(ix: 1, iy: 2, iz: 3, r: 4)
    let data = try JSONEncoder().encode(q)
    #expect(String(decoding: data, as: UTF8.self) == "[1,2,3,4]")
    #expect(try JSONDecoder().decode(simd_quatf.self, from: data) == q)
    #expect(
      q.debugDescription == "simd_quatf(real: 4.0, imag: SIMD3<Float>(1.0, 2.0, 3.0))")
  }
}

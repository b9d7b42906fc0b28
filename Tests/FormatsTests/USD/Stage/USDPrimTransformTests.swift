import SceneModel
import Testing

@testable import Formats

@Suite struct USDPrimTransformTests {
  private func transform(_ operations: [(String, USDValue)]) -> (map: NodeTransform, isReset: Bool)
  {
    var prim = USDPrim("Xform", "x")
    prim.properties = operations.map { .attribute("", $0.0, $0.1) }
    prim.properties.append(
      .attribute("token[]", "xformOpOrder", .tokenArray(operations.map(\.0)), isUniform: true))
    return prim.transform
  }

  private func image(_ operations: [(String, USDValue)], of point: SIMD3<Double>) -> SIMD3<Double> {
    let map = transform(operations).map
    return map.linear * point + map.translation
  }

  private func expect(_ a: SIMD3<Double>, _ b: SIMD3<Double>) {
    #expect((a - b).length < 1e-6, "\(a) instead of \(b)")
  }

  @Test func theFirstOperationIsAppliedLast() {
    expect(
      image(
        [("xformOp:translate", .double3([1, 2, 3])), ("xformOp:scale", .float3([2, 3, 4]))],
        of: [1, 1, 1]), [3, 5, 7])
  }

  @Test func rotationsAreInDegrees() {
    expect(image([("xformOp:rotateZ", .float(90))], of: [1, 0, 0]), [0, 1, 0])
    // First about x, then about z.
    expect(image([("xformOp:rotateXYZ", .float3([90, 0, 90]))], of: [0, 1, 0]), [0, 0, 1])
    expect(image([("xformOp:rotateZYX", .float3([90, 0, 90]))], of: [0, 1, 0]), [-1, 0, 0])
    let half = Float(0.5).squareRoot()
    expect(image([("xformOp:orient", .float4([0, 0, half, half]))], of: [1, 0, 0]), [0, 1, 0])
  }

  @Test func matricesAreForRowVectors() {
    let elements: [Double] = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]
    expect(image([("xformOp:transform", .matrix4(elements))], of: [1, 0, 0]), [5, 7, 7])
  }

  @Test func pivotsAreInverted() {
    var prim = USDPrim("Xform", "x")
    prim.properties = [
      .attribute("double3", "xformOp:translate:pivot", .double3([1, 0, 0])),
      .attribute("float", "xformOp:rotateZ", .float(180)),
      .attribute(
        "token[]", "xformOpOrder",
        .tokenArray([
          "xformOp:translate:pivot", "xformOp:rotateZ", "!invert!xformOp:translate:pivot",
        ])),
    ]
    let map = prim.transform.map
    expect(map.linear * [2, 0, 0] + map.translation, [0, 0, 0])
  }

  @Test func resetsIgnoreTheParents() {
    let reset = transform([("!resetXformStack!", .bool(true))])
    #expect(reset.isReset && reset.map == .identity)
    #expect(transform([("xformOp:rotateQ", .float(1))]).map == .identity)
  }
}

import RealityKit
import Testing

@Suite struct BoundingBoxTests {
  let box = BoundingBox(min: [-1, -2, -3], max: [1, 2, 5])

  @Test func boxesHaveCenterExtentsAndRadius() {
    #expect(box.center == [0, 0, 1] && box.extents == [2, 4, 8])
    #expect(abs(box.boundingRadius - Float(84).squareRoot() / 2) < 1e-6)
    #expect(!box.isEmpty)
  }

  @Test func emptyContainsNothingAndAddsNothing() {
    let empty = BoundingBox()
    #expect(empty.isEmpty && empty == .empty)
    #expect(empty.extents == .zero && empty.center == .zero && empty.boundingRadius == 0)
    #expect(!empty.contains(SIMD3<Float>.zero) && box.contains(empty) && !empty.contains(box))
    #expect(!empty.intersects(box) && !box.intersects(empty))
    #expect(empty.union(box) == box && box.union(empty) == box)
    #expect(empty.union([1, 2, 3]) == BoundingBox(min: [1, 2, 3], max: [1, 2, 3]))
    #expect(empty.transformed(by: float4x4(2)).isEmpty)
    #expect(empty.distanceSquared(toPoint: .zero) == .infinity)
  }

  @Test func boxesContainAndIntersect() {
    #expect(box.contains([1, 2, 5]) && !box.contains([1, 2, 5.01]))
    let other = BoundingBox(min: [0.5, 0, 0], max: [3, 1, 1])
    #expect(box.intersects(other) && !box.contains(other))
    var grown = box
    grown.formUnion(other)
    #expect(grown.contains(other) && grown.contains(box) && grown.max.x == 3)
    grown.formUnion([0, -9, 0])
    #expect(grown.min.y == -9)
    #expect(!box.intersects(BoundingBox(min: [2, 0, 0], max: [3, 1, 1])))
  }

  @Test func distanceIsToTheSurface() {
    #expect(box.distanceSquared(toPoint: [0, 0, 0]) == 0)
    #expect(box.distanceSquared(toPoint: [3, 0, 0]) == 4)
    #expect(box.distanceSquared(toPoint: [4, 6, 5]) == 25)
  }

  @Test func transformedBoxHoldsTheCorners() {
    let matrix = Transform(
      rotation: simd_quatf(angle: 0.6, axis: [0, 0, 1]), translation: [1, 0, 0]
    ).matrix
    var image = box
    image.transform(by: matrix)
    for corner in [SIMD4<Float>(-1, -2, -3, 1), [1, 2, 5, 1], [-1, 2, 5, 1]] {
      let p = matrix * corner
      #expect(image.distanceSquared(toPoint: [p.x, p.y, p.z]) < 1e-10)
    }
    #expect(image.min.z == -3 && image.max.z == 5)
  }

  @Test func survivesJSON() throws {
    let data = try JSONEncoder().encode(box)
    #expect(try JSONDecoder().decode(BoundingBox.self, from: data) == box)
  }
}

@Suite struct TransformTests {
  let transform = Transform(
    scale: [1, 2, 0.5], rotation: simd_quatf(angle: 1.1, axis: normalize([1, 2, -1])),
    translation: [3, -4, 5])

  @Test func survivesItsMatrix() {
    let other = Transform(matrix: transform.matrix)
    #expect(length(other.scale - transform.scale) < 1e-5)
    #expect(abs(abs(dot(other.rotation, transform.rotation)) - 1) < 1e-5)
    #expect(other.translation == transform.translation)
  }

  @Test func scalesThenRotatesThenShifts() {
    let p = SIMD3<Float>(0.3, 1, -2)
    let expected = transform.rotation.act(p * transform.scale) + transform.translation
    let image = transform.matrix * SIMD4(p, 1)
    #expect(length(SIMD3(image.x, image.y, image.z) - expected) < 1e-5)
    #expect(Transform.identity.matrix == matrix_identity_float4x4 && Transform() == .identity)
  }

  @Test func rollsThenPitchesThenYaws() {
    let t = Transform(pitch: 0.3, yaw: 0.8, roll: -0.5)
    func turn(_ angle: Float, _ axis: SIMD3<Float>) -> Transform {
      Transform(rotation: simd_quatf(angle: angle, axis: axis))
    }
    let expected =
      turn(0.8, [0, 1, 0]).matrix * turn(0.3, [1, 0, 0]).matrix * turn(-0.5, [0, 0, 1]).matrix
    #expect(simd_almost_equal_elements(t.matrix, expected, 1e-6))
  }

  @Test func takesReflectionsAndFlatMatrices() {
    let mirror = Transform(matrix: float4x4(diagonal: [1, -1, 1, 1]))
    #expect(simd_almost_equal_elements(mirror.matrix, float4x4(diagonal: [1, -1, 1, 1]), 1e-6))
    let flat = Transform(matrix: float4x4(diagonal: [1, 0, 1, 1]))
    #expect(flat.scale == [1, 0, 1] && flat.rotation.length.isFinite)
    #expect(Transform(matrix: float4x4(0)).matrix.columns.0.x.isFinite)
  }

  @Test func survivesJSON() throws {
    let data = try JSONEncoder().encode(transform)
    #expect(try JSONDecoder().decode(Transform.self, from: data) == transform)
  }
}

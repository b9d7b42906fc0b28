import Foundation
import SceneModel
import Testing

@Suite struct TransformTests {
  @Test func rigidTransformsRotateThenTranslate() {
    let bFromA = RigidTransform(
      rotation: Quaternion(angle: .pi / 2, axis: [0, 0, 1]), translation: [1, 2, 3])
    #expect((bFromA * SIMD3(1, 0, 0) - [1, 3, 3]).length < 1e-15)
    #expect((bFromA.center - [-2, 1, -3]).length < 1e-15)
    #expect(RigidTransform.identity * SIMD3(1, 2, 3) == [1, 2, 3])
  }

  @Test func compositionIsAssociativeAndInvertible() {
    var random = SplitMix64(seed: 7)
    for _ in 0..<100 {
      let (a, b, c) = (random.rigidTransform(), random.rigidTransform(), random.rigidTransform())
      let point = random.vector(5)
      #expect(((a * b) * point - a * (b * point)).length < 1e-12)
      #expect((((a * b) * c) * point - (a * (b * c)) * point).length < 1e-12)
      #expect(((a * b).inverse * point - (b.inverse * a.inverse) * point).length < 1e-12)
      #expect((a.inverse * (a * point) - point).length < 1e-13)
      #expect((a * a.center).length < 1e-13 && (a.inverse.translation - a.center).length < 1e-14)
    }
  }

  @Test func similaritiesScaleRotateThenTranslate() {
    let bFromA = SimilarityTransform(
      scale: 2, rotation: Quaternion(angle: .pi / 2, axis: [1, 0, 0]), translation: [0, 0, 5])
    #expect((bFromA * SIMD3(1, 1, 0) - [2, 0, 7]).length < 1e-15)
    #expect(SimilarityTransform.identity * SIMD3(1, 2, 3) == [1, 2, 3])
  }

  @Test func movedCamerasSeeTheSceneScaled() {
    var random = SplitMix64(seed: 8)
    for _ in 0..<50 {
      let cameraFromA = random.rigidTransform()
      let bFromA = SimilarityTransform(
        scale: 0.1 + random.uniform() * 5, rotation: random.rotation(),
        translation: random.vector(10))
      let cameraFromB = bFromA.applied(toCameraFromA: cameraFromA)
      let point = random.vector(3)
      let (before, after) = (cameraFromA * point, cameraFromB * (bFromA * point))
      #expect((after - bFromA.scale * before).length < 1e-11)
      #expect((cameraFromB.center - bFromA * cameraFromA.center).length < 1e-11)
    }
  }

  @Test func affineMapsActByColumns() {
    let map = AffineMap(x: [1, 2, 3], y: [4, 5, 6], z: [7, 8, 10], translation: [-1, 0, 1])
    #expect(map * SIMD3<Float>(1, 0, 0) == [0, 2, 4])
    #expect(map * SIMD3<Float>(1, 10, 100) == [740, 852, 1064])
    #expect(AffineMap.identity * SIMD3<Float>(1, 2, 3) == [1, 2, 3])
  }

  @Test func mirrorsHaveANegativeDeterminant() {
    #expect(!AffineMap.identity.mirrors)
    #expect(AffineMap(x: [-1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]).mirrors)
    #expect(AffineMap(x: [0, 1, 0], y: [1, 0, 0], z: [0, 0, 1]).mirrors)
    #expect(!AffineMap(x: [-1, 0, 0], y: [0, -1, 0], z: [0, 0, 2]).mirrors)
  }

  /// A surface's normal is perpendicular to the images of its tangents, on the same side.
  @Test func normalsStayPerpendicular() {
    var random = SplitMix64(seed: 9)
    for index in 0..<100 {
      func column() -> SIMD3<Float> { SIMD3<Float>(random.vector(2)) }
      var map = AffineMap(x: column(), y: column(), z: column(), translation: column())
      let size = map.x.dot(map.y.cross(map.z))
      guard abs(size) > 0.2 else { continue }
      if (index % 2 == 0) != map.mirrors { map.x = -map.x }
      let tangents = [column(), column()]
      let cross = tangents[0].cross(tangents[1])
      guard cross.length > 0.2 else { continue }
      let origin = map * SIMD3<Float>.zero
      let normal = map.normal(cross.normalized)
      #expect(abs(normal.length - 1) < 1e-5)
      for tangent in tangents {
        let image = map * tangent - origin
        #expect(abs(normal.dot(image.normalized)) < 1e-3)
      }
      #expect(normal.dot(map * cross.normalized - origin) > 0)
    }
  }
}

import Foundation
import SceneModel
import Testing

@Suite struct GeometryTests {
  let rotation = Quaternion(angle: 0.7, axis: [1, -2, 0.5])

  @Test func quaternionsSurviveTheirMatrix() {
    for angle in stride(from: -3.1, through: 3.1, by: 0.37) {
      for axis in [SIMD3<Double>(1, 0, 0), [0, 1, 0], [0, 0, 1], [1, -2, 0.5]] {
        let q = Quaternion(angle: angle, axis: axis)
        #expect((Quaternion(q.matrix) * q.conjugate).angle < 1e-7)
        #expect(abs(q.matrix.determinant - 1) < 1e-12)
      }
    }
  }

  @Test func quaternionRotatesAsItsMatrixDoes() {
    let v = SIMD3(0.3, -4, 2.5)
    #expect((rotation * v - rotation.matrix * v).length < 1e-12)
    #expect(abs((rotation * v).length - v.length) < 1e-12)
  }

  @Test func rigidTransformComposesWithItsInverse() {
    let bFromA = RigidTransform(rotation: rotation, translation: [1, 2, 3])
    let point = SIMD3(-2, 0.5, 7)
    #expect((bFromA.inverse * (bFromA * point) - point).length < 1e-12)
    #expect(((bFromA * bFromA.inverse).translation).length < 1e-12)
    #expect((bFromA * bFromA.center).length < 1e-12)
  }

  @Test func cameraSeesTheSameAfterASimilarity() {
    let cameraFromA = RigidTransform(rotation: rotation, translation: [0.1, -0.2, 4])
    let bFromA = SimilarityTransform(
      scale: 2.5, rotation: Quaternion(angle: 1.1, axis: [0, 1, 1]), translation: [5, 6, 7])
    let cameraFromB = bFromA.applied(toCameraFromA: cameraFromA)
    let point = SIMD3(0.4, 0.3, -0.2)
    let camera = Camera(width: 640, height: 480, focalLength: [500, 510])
    let difference =
      camera.project(cameraFromB * (bFromA * point)) - camera.project(cameraFromA * point)
    #expect(difference.length < 1e-9)
  }

  @Test(arguments: [SIMD4<Double>.zero, [-0.13, 0.1, 0, 0], [0.05, -0.02, 0.001, -0.002]])
  func unprojectInvertsProject(distortion: SIMD4<Double>) {
    let camera = Camera(
      width: 1092, height: 728, focalLength: [900, 905], principalPoint: [540, 370],
      distortion: distortion)
    for x in stride(from: 0.0, through: 1092, by: 91) {
      for y in stride(from: 0.0, through: 728, by: 91) {
        let ray = camera.unproject([x, y])
        #expect((camera.project([ray.x, ray.y, 1]) - [x, y]).length < 1e-6)
      }
    }
  }

  @Test func resizedCameraKeepsItsRays() {
    let camera = Camera(
      width: 1000, height: 800, focalLength: [900, 905], principalPoint: [480, 410])
    let half = camera.resized(width: 500, height: 400)
    #expect((half.project([0.1, 0.2, 1]) * 2 - camera.project([0.1, 0.2, 1])).length < 1e-9)
  }
}

import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ShadowPlaneTests {
  private let backdrop: SIMD3<Float> = [228, 230, 232]

  /// A gray cylinder with a level top on a white table, of which only the outline of the cylinder's
  /// shadow is reconstructed. The shadow has label 2.
  private func scene(
    hasShadow: Bool = true
  ) -> (scene: IsolationScene, colors: [SIMD3<Float>], reconstruction: Reconstruction) {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    for turn in 0..<120 {
      let angle = Double(turn) * 2 * .pi / 120
      let outward = SIMD3(cos(angle), 0, sin(angle))
      for step in 1..<25 {
        let height = SIMD3(0, 0.02 * Double(step), 0)
        scene.add(0.4 * outward + height, normal: outward, label: 1, centers: centers)
        scene.add(
          0.016 * Double(step) * outward + [0, 0.5, 0], normal: [0, 1, 0], label: 1,
          centers: centers)
      }
      for width in [0.6, 0.62, 0.64] where hasShadow {
        scene.add(
          width * outward + [0.1, 0, 0], normal: [0, 1, 0], label: 2, centers: centers)
      }
    }
    let colors = scene.labels.map { $0 == 2 ? 0.8 * backdrop : SIMD3<Float>(120, 121, 122) }
    return (scene, colors, reconstruction)
  }

  @Test func outlineOfAShadowIsOnTheSupport() throws {
    let (scene, colors, reconstruction) = scene()
    let found = try #require(
      ShadowPlane().run(scene.cloud, colors: colors, backdrop: backdrop, reconstruction))
    #expect(found.plane.normal.y > 0.999 && abs(found.plane.offset) < 0.01)
    #expect(scene.labels.indices.allSatisfy { found.isShadow[$0] || scene.labels[$0] == 1 })
    let object = scene.labels.indices.filter { scene.labels[$0] == 1 }
    #expect(object.count { found.isShadow[$0] } < object.count / 20)
  }

  /// The level top of the object has much below it.
  @Test func objectWithoutAShadowHasNoPlane() {
    let (scene, colors, reconstruction) = scene(hasShadow: false)
    #expect(
      ShadowPlane().run(scene.cloud, colors: colors, backdrop: backdrop, reconstruction) == nil)
  }

  @Test func pointsOfAnotherHueAreNoShadow() {
    let (scene, _, reconstruction) = scene()
    let colors = scene.labels.map { _ in SIMD3<Float>(180, 120, 90) }
    #expect(
      ShadowPlane().run(scene.cloud, colors: colors, backdrop: backdrop, reconstruction) == nil)
  }

  @Test func blackBackdropShowsNoShadow() {
    let (scene, colors, reconstruction) = scene()
    #expect(
      ShadowPlane().run(scene.cloud, colors: colors, backdrop: [20, 20, 20], reconstruction)
        == nil)
  }
}

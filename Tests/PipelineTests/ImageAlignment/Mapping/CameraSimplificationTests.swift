import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct CameraSimplificationTests {
  private func simplified(_ camera: Camera) throws -> Camera {
    var options = SyntheticScene.Options()
    (options.camera, options.pixelNoise, options.photoCount) = (camera, 0.3, 12)
    let scene = SyntheticScene(options)
    var map = SparseMap(scene.reconstruction)
    var first = camera
    (first.distortion, first.principalPoint) = (
      .zero, [Double(camera.width) / 2, Double(camera.height) / 2]
    )
    var adjustment = MapAdjustment(initialCameras: [first])
    try adjustment.adjustGlobally(&map, KernelControl())
    try adjustment.simplifyCameras(&map, KernelControl())
    return map.photos.cameras[0]
  }

  @Test func distortionOfAPinholeCameraIsRemoved() throws {
    let camera = try simplified(SyntheticScene.Options().camera)
    #expect(camera.distortion == .zero)
    #expect(camera.principalPoint == [800, 600])
  }

  @Test func actualDistortionIsKept() throws {
    var camera = SyntheticScene.Options().camera
    (camera.distortion.x, camera.principalPoint) = (-0.08, [812, 590])
    let found = try simplified(camera)
    #expect(abs(found.distortion.x + 0.08) < 0.01)
    #expect((found.principalPoint - [812, 590]).length < 3)
  }
}

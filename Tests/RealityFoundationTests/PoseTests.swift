import RealityFoundation
import SceneModel
import Testing

@testable import RealityFoundation

@Suite struct PoseTests {
  let camera = SceneModel.Camera(
    width: 400, height: 300, focalLength: [500, 510], principalPoint: [190, 160],
    distortion: [-0.1, 0.02, 0, 0])
  let cameraFromWorld = RigidTransform(
    rotation: Quaternion(angle: 0.8, axis: [0.2, 1, -0.4]), translation: [0.3, -0.1, 4])

  @Test func camerasLookAlongMinusZ() {
    let pose = PhotogrammetrySession.Pose(cameraFromWorld: cameraFromWorld, camera: camera)
    // A point to the right of, below and in front of the camera. In RealityKit's camera frame x
    // points right, y up and z toward the viewer.
    let inCamera = SIMD3(0.5, 0.25, 2.0)
    let world = cameraFromWorld.inverse * inCamera
    let mirrored = SIMD4<Float>(0.5, -0.25, -2, 1)
    let image = pose.transform.matrix * mirrored
    #expect(length(SIMD3(image.x, image.y, image.z) - SIMD3<Float>(world)) < 1e-5)
    #expect(pose.transform.scale == [1, 1, 1])
    #expect(length(pose.translation - SIMD3<Float>(cameraFromWorld.center)) < 1e-6)
  }

  @Test func intrinsicsProjectLikeTheCamera() throws {
    let pose = PhotogrammetrySession.Pose(cameraFromWorld: cameraFromWorld, camera: camera)
    let pixel = try #require(pose.intrinsics) * SIMD3<Float>(0.1, -0.2, 1)
    #expect(length(SIMD2(pixel.x, pixel.y) - [240, 58]) < 1e-4 && pixel.z == 1)
    let lens = try #require(pose.lensDistortionData)
    #expect(lens.radialLookupTable.first == 0 && lens.center == [190, 160])
    let corner = (SIMD2(210.0, 160) / SIMD2(500, 510)).squaredLength
    let expected = Float(-0.1 * corner + 0.02 * corner * corner)
    #expect(abs(try #require(lens.radialLookupTable.last) - expected) < 1e-6)
    let pinhole = SceneModel.Camera(width: 4, height: 3, focalLength: [5, 5])
    #expect(LensDistortionData(pinhole) == nil)
  }

  @Test func samplesKeepTheirIDs() throws {
    let photos = (0..<3).map { index in
      Photo(
        id: ID(index), sampleID: index * 2, name: "\(index)",
        url: URL(fileURLWithPath: "/\(index)"),
        width: 400, height: 300, orientation: 1, camera: ID(0))
    }
    let reconstruction = Reconstruction(
      cameras: [camera], photos: photos, poses: [cameraFromWorld, nil, .identity], points: [])
    let poses = PhotogrammetrySession.Poses(reconstruction, sampleIDs: nil)
    #expect(poses.posesBySample.keys.sorted() == [0, 4])
    #expect(poses.urlsBySample[4]?.path == "/2" && poses.urlsBySample.count == 2)
    let samples = PhotogrammetrySession.Poses(reconstruction, sampleIDs: [10, 11, 12, 13, 14])
    #expect(samples.posesBySample.keys.sorted() == [10, 14] && samples.urlsBySample.isEmpty)
  }
}

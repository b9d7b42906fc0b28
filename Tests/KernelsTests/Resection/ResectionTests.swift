import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct ResectionTests {
  @Test func threeExactPointsGiveTheTruePose() throws {
    var random = SeededGenerator(seed: 3)
    var missed = 0
    for _ in 0..<2000 {
      let pose = RigidTransform(
        rotation: Quaternion(angle: 6 * random.uniform(), axis: random.normal3()),
        translation: random.normal3())
      let inCamera = (0..<3).map { _ in random.normal3() + [0, 0, 6] }
      let points = inCamera.map { pose.inverse * $0 }
      let poses = try Resection.perspectiveThreePoint(rays: inCamera, points: points)
      #expect(poses.count <= 4)
      for found in poses {
        // Every solution sees the points along their rays.
        for (ray, point) in zip(inCamera, points) {
          #expect(((found * point).normalized - ray.normalized).length < 1e-6)
        }
      }
      let best = poses.map { ($0.center - pose.center).length }.min() ?? .infinity
      if best > 1e-5 { missed += 1 }
    }
    #expect(missed <= 2)
  }

  @Test func degenerateTriplesGiveNoPose() throws {
    let rays: [SIMD3<Double>] = [[0, 0, 1], [0.1, 0, 1], [0.2, 0.1, 1]]
    #expect(
      try Resection.perspectiveThreePoint(
        rays: rays, points: [[0, 0, 5], [1, 0, 5], [2, 0, 5]]
      ).isEmpty)
    #expect(
      try Resection.perspectiveThreePoint(
        rays: rays, points: [[1, 1, 5], [1, 1, 5], [2, 0, 5]]
      ).isEmpty)
    #expect(throws: KernelError.self) {
      try Resection.perspectiveThreePoint(
        rays: rays, points: [[.nan, 0, 5], [1, 0, 5], [2, 0, 5]])
    }
  }

  @Test(arguments: [0.0, 0.5, 1.0], [0.0, 0.3, 0.6])
  func poseSurvivesNoiseAndOutliers(pixels noise: Double, outliers: Double) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = noise
    options.camera.distortion = [-0.1, 0.02, 0, 0]
    let scene = SyntheticScene(options)
    var random = SeededGenerator(seed: 9)
    for photo in 0..<4 {
      let pixels = scene.features[photo].positions.map { position in
        random.uniform() < outliers
          ? SIMD2(1600 * random.uniform(), 1200 * random.uniform()) : SIMD2<Double>(position)
      }
      let points = scene.pointOfFeature[photo].map { scene.points[Int($0)] }
      let result = try Resection().run(pixels: pixels, points: points, camera: scene.camera)
      let truth = scene.poses[photo]
      #expect((result.cameraFromWorld.center - truth.center).length < 1e-4 + 0.02 * noise)
      let rotation = result.cameraFromWorld.rotation * truth.rotation.conjugate
      #expect(rotation.angle < 1e-4 + 0.005 * noise)
      #expect(Double(result.inlierCount) > 0.9 * (1 - outliers) * Double(pixels.count))
    }
  }

  @Test func planarPointsGiveThePose() throws {
    var options = SyntheticScene.Options()
    options.isPlanar = true
    let scene = SyntheticScene(options)
    let result = try Resection().run(
      pixels: scene.features[2].positions.map { SIMD2<Double>($0) },
      points: scene.pointOfFeature[2].map { scene.points[Int($0)] }, camera: scene.camera)
    #expect((result.cameraFromWorld.center - scene.poses[2].center).length < 1e-4)
  }

  @Test func randomPixelsAndTooFewPointsAreDegenerate() {
    let scene = SyntheticScene()
    var random = SeededGenerator(seed: 2)
    let points = Array(scene.points.prefix(100))
    let pixels = points.map { _ in SIMD2(1600 * random.uniform(), 1200 * random.uniform()) }
    #expect(throws: KernelError.self) {
      try Resection().run(pixels: pixels, points: points, camera: scene.camera)
    }
    #expect(throws: KernelError.self) {
      try Resection().run(pixels: [], points: [], camera: scene.camera)
    }
  }

  @Test func canceledSearchThrows() {
    let scene = SyntheticScene()
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try Resection().run(
        pixels: scene.features[0].positions.map { SIMD2<Double>($0) },
        points: scene.pointOfFeature[0].map { scene.points[Int($0)] }, camera: scene.camera,
        control: KernelControl(flag: flag))
    }
  }
}

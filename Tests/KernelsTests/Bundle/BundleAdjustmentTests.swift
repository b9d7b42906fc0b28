import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct BundleAdjustmentTests {
  let camera: Camera = {
    var camera = Camera(
      width: 1600, height: 1200, focalLength: [1400, 1410], principalPoint: [810, 590])
    camera.distortion = [-0.12, 0.05, 0.001, -0.002]
    return camera
  }()

  @Test func jacobiansMatchFiniteDifferences() throws {
    let pose = RigidTransform(
      rotation: Quaternion(angle: 0.7, axis: [1, -2, 0.5]), translation: [0.2, -0.1, 5])
    let (point, pixel) = (SIMD3(0.4, -0.7, 0.9), SIMD2(700.0, 500.0))
    let found = try BundleAdjustment.jacobians(
      camera: camera, cameraFromWorld: pose, point: point, pixel: pixel)
    #expect((found.residual - (camera.project(pose * point) - pixel)).length < 1e-10)

    func difference(_ step: Double, _ value: (Double) -> SIMD2<Double>) -> SIMD2<Double> {
      (value(step) - value(-step)) / (2 * step)
    }
    for axis in 0..<3 {
      var unit = SIMD3<Double>.zero
      unit[axis] = 1
      let byRotation = difference(1e-6) { h in
        let tilt = Quaternion(angle: h, axis: unit)
        return camera.project(tilt * (pose.rotation * point) + pose.translation)
      }
      let byTranslation = difference(1e-6) { camera.project(pose * point + $0 * unit) }
      let byPoint = difference(1e-6) { camera.project(pose * (point + $0 * unit)) }
      for row in 0..<2 {
        #expect(abs(found.pose[6 * row + axis] - byRotation[row]) < 1e-4)
        #expect(abs(found.pose[6 * row + 3 + axis] - byTranslation[row]) < 1e-4)
        #expect(abs(found.point[3 * row + axis] - byPoint[row]) < 1e-4)
      }
    }
    for parameter in 0..<7 {
      let byCamera = difference(1e-6) { h in
        var changed = camera
        switch parameter {
        case 0: changed.focalLength *= (camera.focalLength.x + h) / camera.focalLength.x
        case 1, 2: changed.principalPoint[parameter - 1] += h
        default: changed.distortion[parameter - 3] += h
        }
        return changed.project(pose * point)
      }
      for row in 0..<2 {
        #expect(abs(found.camera[7 * row + parameter] - byCamera[row]) < 1e-3)
      }
    }
  }

  /// The scene's true bundle with everything except the first pose slightly perturbed.
  private func perturbed(_ scene: SyntheticScene) -> BundleAdjustment.Problem {
    var random = SeededGenerator(seed: 11)
    let truth = scene.reconstruction
    var photos = PosedPhotos(
      cameras: [scene.camera], poses: scene.poses, cameraOfPhoto: scene.poses.map { _ in 0 })
    for index in 1..<scene.poses.count {
      let tilt = Quaternion(angle: 0.01, axis: random.normal3())
      photos.poses[index] = RigidTransform(
        rotation: (tilt * scene.poses[index].rotation).normalized,
        translation: scene.poses[index].translation + 0.02 * random.normal3())
    }
    photos.cameras[0].focalLength *= 1.05
    photos.cameras[0].principalPoint += [10, -8]
    photos.cameras[0].distortion = .zero
    var problem = BundleAdjustment.Problem(
      photos: photos, points: truth.points.map { $0.position + 0.02 * random.normal3() },
      observations: truth.points.enumerated().flatMap { index, point in
        point.track.map {
          PointObservation(photo: $0.photo.rawValue, point: Int32(index), pixel: $0.pixel)
        }
      })
    problem.cameraFreedom[0] = [.focalLength, .k1, .k2, .principalPoint]
    problem.poseFreedom[0] = .constant
    problem.poseFreedom[3] = .scaleFixed
    return problem
  }

  @Test(arguments: [0.0, 0.5, 1.0])
  func perturbedSceneIsRecovered(pixels noise: Double) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = noise
    options.camera.distortion = [-0.08, 0.02, 0, 0]
    let scene = SyntheticScene(options)
    var problem = perturbed(scene)
    let summary = try BundleAdjustment().run(&problem)
    #expect(summary.finalCost < summary.initialCost)
    let found = problem.photos.cameras[0]
    #expect(abs(found.focalLength.x - scene.camera.focalLength.x) < 0.05 + 8 * noise)
    #expect((found.principalPoint - scene.camera.principalPoint).length < 0.1 + 14 * noise)
    #expect(abs(found.distortion.x - -0.08) < 0.001 + 0.02 * noise)
    let poses = PoseComparison(estimated: problem.photos.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 1e-4 + 0.01 * noise)
    #expect(poses.maximumRotationError < 1e-4 + 0.012 * noise)
  }

  /// A scene in which every photo has a camera of its own: points link cameras with each other.
  private func perturbedCameras(_ scene: SyntheticScene) -> BundleAdjustment.Problem {
    var problem = perturbed(scene)
    let count = scene.poses.count
    problem.photos.cameras = Array(repeating: problem.photos.cameras[0], count: count)
    problem.photos.cameraOfPhoto = (0..<count).map(Int32.init)
    problem.cameraFreedom = Array(repeating: [.focalLength, .k1], count: count)
    problem.cameraPriors = Array(repeating: BundleAdjustment.CameraPrior(), count: count)
    return problem
  }

  @Test func camerasOfTheirOwnAreRecovered() throws {
    let scene = SyntheticScene()
    var problem = perturbedCameras(scene)
    for index in problem.photos.cameras.indices {
      problem.photos.cameras[index].principalPoint = scene.camera.principalPoint
    }
    try BundleAdjustment().run(&problem)
    for camera in problem.photos.cameras {
      #expect(abs(camera.focalLength.x - scene.camera.focalLength.x) < 0.1)
    }
    let poses = PoseComparison(estimated: problem.photos.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 1e-3)
  }

  /// Limits of photos for the dense solver and of work for the direct one: one for each of the
  /// three solvers.
  static let solverLimits = [(60, 1e11), (0, 1e11), (0, 0)]

  @Test(arguments: solverLimits)
  func resultDoesNotDependOnThreads(dense: Int, direct: Double) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.5
    let scene = SyntheticScene(options)
    for start in [perturbed(scene), perturbedCameras(scene)] {
      var solver = BundleAdjustment()
      solver.options.densePhotoLimit = dense
      solver.options.directWork = direct
      let found = try [1, 2, 3, 8].map { threads in
        var problem = start
        try solver.run(&problem, control: KernelControl(threadCount: threads))
        return problem
      }
      for other in found.dropFirst() {
        #expect(other.points == found[0].points)
        #expect(other.photos.poses == found[0].photos.poses)
        #expect(other.photos.cameras == found[0].photos.cameras)
      }
    }
  }

  /// Dense and sparse factorizations and conjugate gradients find the same minimum.
  @Test func solversAgree() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.5
    let scene = SyntheticScene(options)
    for start in [perturbed(scene), perturbedCameras(scene)] {
      let costs = try Self.solverLimits.map { dense, direct in
        var problem = start
        var solver = BundleAdjustment()
        solver.options.densePhotoLimit = dense
        solver.options.directWork = direct
        solver.options.maximumIterations = 200
        solver.options.functionTolerance = 1e-9
        return try solver.run(&problem).finalCost
      }
      #expect(abs(costs[1] - costs[0]) < 1e-5 * costs[0])
      #expect(abs(costs[2] - costs[0]) < 1e-5 * costs[0])
    }
  }

  /// A street of photos, each of which shares points with a few others: the eliminated system is
  /// sparse. Three cameras take turns; the start is perturbed.
  private func street(photos count: Int) -> BundleAdjustment.Problem {
    var random = SeededGenerator(seed: 5)
    let centers = (0..<count).map { SIMD3(0.5 * Double($0), 0, 0) + 0.1 * random.normal3() }
    let truth = centers.map {
      RigidTransform(rotation: Quaternion(angle: 0.02, axis: random.normal3()), translation: -$0)
    }
    let points = (0..<40 * count).map { _ in
      SIMD3(0.5 * Double(count) * random.uniform(), 2 * random.uniform() - 1, 5 + random.uniform())
    }
    var observations: [PointObservation] = []
    for (index, point) in points.enumerated() {
      for (photo, center) in centers.enumerated() where abs(center.x - point.x) < 1.5 {
        observations.append(
          PointObservation(
            photo: Int32(photo), point: Int32(index), pixel: camera.project(truth[photo] * point)))
      }
    }
    let photos = PosedPhotos(
      cameras: Array(repeating: camera, count: 3), poses: truth.map { $0 },
      cameraOfPhoto: (0..<count).map { Int32($0 % 3) })
    var problem = BundleAdjustment.Problem(
      photos: photos, points: points.map { $0 + 0.01 * random.normal3() },
      observations: observations)
    problem.cameraFreedom = Array(repeating: [.focalLength, .k1], count: 3)
    problem.poseFreedom[0] = .constant
    problem.poseFreedom[1] = .scaleFixed
    return problem
  }

  /// A step with the sparse factorization is that with the dense one, with any number of threads.
  @Test(arguments: [2, 3, 30, 200]) func sparseStepIsThatOfDense(photos count: Int) throws {
    let start = street(photos: count)
    func step(dense: Int, threads: Int) throws -> BundleAdjustment.Problem {
      var problem = start
      var solver = BundleAdjustment()
      solver.options.densePhotoLimit = dense
      solver.options.maximumIterations = 1
      let summary = try solver.run(&problem, control: KernelControl(threadCount: threads))
      #expect(summary.finalCost < 0.1 * summary.initialCost)
      return problem
    }
    let dense = try step(dense: count, threads: 1)
    let sparse = try [1, 3].map { try step(dense: 0, threads: $0) }
    for (a, b) in zip(dense.points, sparse[0].points) { #expect((a - b).length < 1e-8) }
    #expect(sparse[1].points == sparse[0].points)
    #expect(sparse[1].photos.poses == sparse[0].photos.poses)
    #expect(sparse[1].photos.cameras == sparse[0].photos.cameras)
  }

  /// At the minimum of a robust cost with outliers and priors, every small change raises the cost.
  @Test func minimumIsStationary() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.5
    var problem = perturbed(SyntheticScene(options))
    for index in stride(from: 0, to: problem.observations.count, by: 17) {
      problem.observations[index].pixel += [40, -25]
    }
    problem.cameraPriors[0].focalLength = 1300
    problem.cameraPriors[0].focalLengthDeviation = 0.01
    problem.cameraPriors[0].radialDeviation = 0.1
    var solver = BundleAdjustment()
    solver.options.maximumIterations = 200
    solver.options.functionTolerance = 1e-13
    let minimum = try solver.run(&problem).finalCost

    /// The cost after a change, without any iteration.
    func cost(_ change: (inout BundleAdjustment.Problem) -> Void) throws -> Double {
      var changed = problem
      change(&changed)
      var evaluation = BundleAdjustment()
      evaluation.options.maximumIterations = 0
      return try evaluation.run(&changed).initialCost
    }
    for sign in [-1.0, 1.0] {
      #expect(try cost { $0.photos.cameras[0].focalLength *= 1 + sign * 1e-3 } > minimum)
      #expect(try cost { $0.photos.cameras[0].principalPoint.y += sign } > minimum)
      #expect(try cost { $0.photos.cameras[0].distortion.x += sign * 1e-3 } > minimum)
      #expect(try cost { $0.photos.poses[5]?.translation.z += sign * 1e-3 } > minimum)
      #expect(try cost { $0.points[11].x += sign * 1e-3 } > minimum)
    }
  }

  @Test func constantParametersAreUnchanged() throws {
    let scene = SyntheticScene()
    var problem = perturbed(scene)
    problem.cameraFreedom[0] = []
    problem.poseFreedom = problem.poseFreedom.map { _ in .constant }
    problem.poseFreedom[5] = .free
    problem.isPointFree[7] = false
    let before = problem
    try BundleAdjustment().run(&problem)
    #expect(problem.photos.cameras == before.photos.cameras)
    #expect(problem.points[7] == before.points[7])
    #expect(problem.points[8] != before.points[8])
    for index in scene.poses.indices where index != 5 {
      let (a, b) = (problem.photos.poses[index], before.photos.poses[index])
      #expect(a?.translation == b?.translation)
    }
    #expect(problem.photos.poses[5] != before.photos.poses[5])
  }

  @Test func canceledAdjustmentThrowsAndKeepsTheProblem() {
    var problem = perturbed(SyntheticScene())
    let before = problem.points
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > 0 { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try BundleAdjustment().run(&problem, control: control)
    }
    let isUnchanged = problem.points == before
    #expect(isUnchanged)
  }

  @Test func invalidIndicesAreRejected() {
    var problem = perturbed(SyntheticScene())
    problem.observations[0].point = 1_000_000
    #expect(throws: KernelError.self) { try BundleAdjustment().run(&problem) }
  }
}

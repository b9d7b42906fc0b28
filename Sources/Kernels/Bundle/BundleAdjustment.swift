import CKernels
import SceneModel

/// Jointly optimizes cameras, poses and points: minimizes the Huber loss of the reprojection errors
/// (Triggs et al., "Bundle adjustment: a modern synthesis", 1999).
package struct BundleAdjustment: Sendable {
  /// Solver parameters.
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum number of Levenberg–Marquardt iterations. Chosen: the default of Ceres, too.
    package var maximumIterations = 50
    /// Residual at which the Huber loss changes from quadratic to linear, in pixels. Chosen.
    package var huberWidth = 1.0
    /// Stops when the relative decrease of the cost falls below this. Chosen: the default of Ceres,
    /// too.
    package var functionTolerance = 1e-6
    /// Above this number of free photos, reduced camera systems are factorized as sparse matrices.
    /// Chosen.
    package var densePhotoLimit = 60
    /// Systems whose factorization takes more multiplications are solved by preconditioned
    /// conjugate gradients. Chosen: some ten seconds. 3000 photos of a town take 7e9, 1000 that all
    /// show the same points 4e10.
    package var directWork = 1e11

    package init() {}
  }

  /// The camera parameters to optimize; fx and fy keep their ratio.
  package struct CameraFreedom: OptionSet, Hashable, Sendable {
    package let rawValue: UInt32

    package init(rawValue: UInt32) { self.rawValue = rawValue }

    /// fx and fy, with a fixed ratio.
    package static let focalLength = CameraFreedom(rawValue: ck_free_focal_length.rawValue)
    package static let k1 = CameraFreedom(rawValue: ck_free_k1.rawValue)
    package static let k2 = CameraFreedom(rawValue: ck_free_k2.rawValue)
    /// cx and cy.
    package static let principalPoint = CameraFreedom(rawValue: ck_free_principal_point.rawValue)
    /// p1 and p2.
    package static let tangential = CameraFreedom(rawValue: ck_free_tangential.rawValue)
  }

  /// Prior knowledge of a camera; a deviation of 0 means no prior.
  package struct CameraPrior: Hashable, Sendable {
    /// Pixels.
    package var focalLength = 1.0
    /// Pixels.
    package var principalPoint = SIMD2<Double>.zero
    /// Standard deviation relative to the focal length.
    package var focalLengthDeviation = 0.0
    /// Standard deviation in pixels.
    package var principalPointDeviation = 0.0
    /// Standard deviation of k1 and k2 about zero.
    package var radialDeviation = 0.0

    package init() {}
  }

  /// How a photo's pose is optimized.
  package enum PoseFreedom: UInt8, Hashable, Sendable {
    /// The pose is fixed.
    case constant = 0
    /// Rotation and translation are optimized.
    case free = 1
    /// Free except for the largest component of its translation, which fixes the scale gauge.
    case scaleFixed = 2
  }

  /// The scene to optimize.
  package struct Problem: Sendable {
    /// Cameras and poses, the initial values.
    package var photos: PosedPhotos
    /// World frame.
    package var points: [SIMD3<Double>]
    /// The pixels at which photos observe points.
    package var observations: [PointObservation]
    /// One value per camera.
    package var cameraFreedom: [CameraFreedom]
    /// One value per camera.
    package var cameraPriors: [CameraPrior]
    /// One value per photo.
    package var poseFreedom: [PoseFreedom]
    /// Whether each point is optimized.
    package var isPointFree: [Bool]

    /// A problem with constant cameras, free points, and free poses of all photos that have one.
    package init(
      photos: PosedPhotos, points: [SIMD3<Double>], observations: [PointObservation]
    ) {
      self.photos = photos
      self.points = points
      self.observations = observations
      cameraFreedom = photos.cameras.map { _ in [] }
      cameraPriors = photos.cameras.map { _ in CameraPrior() }
      poseFreedom = photos.poses.map { $0 == nil ? .constant : .free }
      isPointFree = points.map { _ in true }
    }
  }

  /// Result of the solver.
  package struct Summary: Hashable, Sendable {
    /// The total loss in square pixels before and after.
    package var initialCost: Double
    package var finalCost: Double
    /// Number of iterations.
    package var iterations: Int
    /// Whether the solver stopped before the maximum number of iterations.
    package var hasConverged: Bool
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Optimizes `problem` in place. Throws `KernelError` for inconsistent input, and
  /// `CancellationError`.
  @discardableResult
  package func run(
    _ problem: inout Problem, control: KernelControl = KernelControl()
  ) throws -> Summary {
    let photos = problem.photos
    guard
      problem.cameraFreedom.count == photos.cameras.count,
      problem.cameraPriors.count == photos.cameras.count,
      problem.poseFreedom.count == photos.poses.count,
      problem.isPointFree.count == problem.points.count
    else { throw KernelError.invalidArgument("the arrays of a bundle differ in length") }
    let scene = Scene(problem)
    var summary = ck_bundle_summary()
    var rawOptions = options.raw
    try withKernel(control) { scene.adjust(&rawOptions, $0, &summary) }
    scene.store(in: &problem)
    return Summary(
      initialCost: summary.initial_cost, finalCost: summary.final_cost,
      iterations: Int(summary.iterations), hasConverged: summary.converged)
  }

  /// The reprojection error of one observation in pixels, with its derivatives in row-major order:
  /// 2×6 with respect to the pose (left-multiplied rotation vector, translation), 2×3 to the point,
  /// 2×7 to the camera (fx with fy in proportion, cx, cy, k1, k2, p1, p2).
  package static func jacobians(
    camera: Camera, cameraFromWorld: RigidTransform, point: SIMD3<Double>, pixel: SIMD2<Double>
  ) throws -> (residual: SIMD2<Double>, pose: [Double], point: [Double], camera: [Double]) {
    var residual = [Double](repeating: 0, count: 2)
    var byPose = [Double](repeating: 0, count: 12)
    var byPoint = [Double](repeating: 0, count: 6)
    var byCamera = [Double](repeating: 0, count: 14)
    var model = ck_camera(camera)
    var pose = ck_pose(cameraFromWorld)
    try withKernel(KernelControl()) { _ in
      ck_reprojection_jacobians(
        &model, &pose, [point.x, point.y, point.z], [pixel.x, pixel.y], &residual, &byPose,
        &byPoint, &byCamera)
    }
    return ([residual[0], residual[1]], byPose, byPoint, byCamera)
  }
}

extension ck_camera_prior {
  fileprivate init(_ prior: BundleAdjustment.CameraPrior) {
    self.init(
      focal_length: prior.focalLength, cx: prior.principalPoint.x, cy: prior.principalPoint.y,
      focal_deviation: prior.focalLengthDeviation,
      principal_point_deviation: prior.principalPointDeviation,
      radial_deviation: prior.radialDeviation)
  }
}

extension BundleAdjustment.Options {
  fileprivate var raw: ck_bundle_options {
    ck_bundle_options(
      maximum_iterations: Int32(maximumIterations), huber_width: huberWidth,
      function_tolerance: functionTolerance, dense_photo_limit: Int32(densePhotoLimit),
      direct_work: directWork)
  }
}

/// A copy of a problem in the memory layout of the kernel.
private struct Scene {
  private let cameras: KernelArray<ck_camera>
  private let cameraFreedom: KernelArray<UInt32>
  private let cameraPriors: KernelArray<ck_camera_prior>
  private let poses: KernelArray<ck_pose>
  private let photoCameras: KernelArray<Int32>
  private let poseFreedom: KernelArray<UInt8>
  private let points: KernelArray<SIMD3<Double>>
  private let pointFreedom: KernelArray<UInt8>
  private let observations: KernelArray<ck_observation>

  init(_ problem: BundleAdjustment.Problem) {
    cameras = KernelArray(problem.photos.cameras.lazy.map(ck_camera.init))
    cameraFreedom = KernelArray(problem.cameraFreedom.lazy.map(\.rawValue))
    cameraPriors = KernelArray(problem.cameraPriors.lazy.map(ck_camera_prior.init))
    poses = KernelArray(problem.photos.poses.lazy.map { ck_pose($0 ?? .identity) })
    photoCameras = KernelArray(problem.photos.cameraOfPhoto)
    poseFreedom = KernelArray(problem.poseFreedom.lazy.map(\.rawValue))
    points = KernelArray(problem.points)
    pointFreedom = KernelArray(problem.isPointFree.lazy.map { $0 ? 1 : 0 })
    observations = KernelArray(problem.observations.lazy.map(\.raw))
  }

  func adjust(
    _ options: inout ck_bundle_options, _ control: UnsafePointer<ck_control>,
    _ summary: inout ck_bundle_summary
  ) -> ck_status {
    var bundle = ck_bundle(
      cameras: cameras.base, camera_freedom: cameraFreedom.base,
      camera_priors: cameraPriors.base, camera_count: cameras.count, poses: poses.base,
      photo_cameras: photoCameras.base, pose_freedom: poseFreedom.base,
      photo_count: poses.count, points: points.mutableSpan, point_freedom: pointFreedom.base,
      observations: observations.base, observation_count: observations.count)
    return withExtendedLifetime(self) { ck_bundle_adjust(&bundle, &options, control, &summary) }
  }

  /// Copies the adjusted values back; photos without a pose remain without one.
  func store(in problem: inout BundleAdjustment.Problem) {
    problem.points = Array(points.elements)
    for (index, pose) in poses.elements.enumerated() where problem.photos.poses[index] != nil {
      problem.photos.poses[index] = RigidTransform(pose)
    }
    for (index, camera) in cameras.elements.enumerated() {
      problem.photos.cameras[index].focalLength = [camera.fx, camera.fy]
      problem.photos.cameras[index].principalPoint = [camera.cx, camera.cy]
      problem.photos.cameras[index].distortion = [camera.k1, camera.k2, camera.p1, camera.p2]
    }
  }
}

import CKernels
import SceneModel

/// Jointly optimizes cameras, poses and points: minimizes the Huber loss of the reprojection errors
/// (Triggs et al., "Bundle adjustment: a modern synthesis", 1999), using Ceres.
package struct BundleAdjustment: Sendable {
  /// Solver parameters.
  package struct Options: Hashable, Codable, Sendable {
    package var maximumIterations = 50
    /// Residual at which the Huber loss changes from quadratic to linear, in pixels.
    package var huberWidth = 1.0
    /// Stops when the relative decrease of the cost falls below this.
    package var functionTolerance = 1e-6
    /// Above this number of photos, systems are factorized sparsely.
    package var densePhotoLimit = 60
    /// Above this number of photos, systems are solved by preconditioned conjugate gradients.
    package var directPhotoLimit = 1000

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
    /// Standard deviation of the focal length as a share of it.
    package var focalLengthDeviation = 0.0
    /// Standard deviation in pixels.
    package var principalPointDeviation = 0.0
    /// Standard deviation of k1 and k2 around zero.
    package var radialDeviation = 0.0

    package init() {}
  }

  /// How a photo's pose is optimized.
  package enum PoseFreedom: UInt8, Hashable, Sendable {
    case constant = 0
    case free = 1
    /// Free except for the largest component of its translation, which fixes the scale gauge.
    case scaleFixed = 2
  }

  /// The scene to optimize.
  package struct Problem: Sendable {
    package var photos: PosedPhotos
    /// World frame.
    package var points: [SIMD3<Double>]
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
    var models = photos.cameras.map(ck_camera_model.init)
    var poses = photos.poses.map { ck_pose($0 ?? .identity) }
    var points = problem.points
    var summary = ck_bundle_summary()
    try solve(problem, &models, &poses, &points, &summary, control)
    problem.points = points
    for (index, pose) in poses.enumerated() where photos.poses[index] != nil {
      problem.photos.poses[index] = RigidTransform(pose)
    }
    for (index, model) in models.enumerated() {
      problem.photos.cameras[index].focalLength = [model.fx, model.fy]
      problem.photos.cameras[index].principalPoint = [model.cx, model.cy]
      problem.photos.cameras[index].distortion = [model.k1, model.k2, model.p1, model.p2]
    }
    return Summary(
      initialCost: summary.initial_cost, finalCost: summary.final_cost,
      iterations: Int(summary.iterations), hasConverged: summary.converged)
  }

  /// Calls the solver with the arrays pinned.
  private func solve(
    _ problem: Problem, _ models: inout [ck_camera_model], _ poses: inout [ck_pose],
    _ points: inout [SIMD3<Double>], _ summary: inout ck_bundle_summary, _ control: KernelControl
  ) throws {
    var rawOptions = ck_bundle_options(
      maximum_iterations: Int32(options.maximumIterations), huber_width: options.huberWidth,
      function_tolerance: options.functionTolerance,
      dense_photo_limit: Int32(options.densePhotoLimit),
      direct_photo_limit: Int32(options.directPhotoLimit))
    let freedom = problem.cameraFreedom.map(\.rawValue)
    let priors = problem.cameraPriors.map(ck_camera_prior.init)
    let poseFreedom = problem.poseFreedom.map(\.rawValue)
    let pointFreedom = problem.isPointFree.map { UInt8($0 ? 1 : 0) }
    let observations = problem.observations.map(\.raw)
    try withKernel(control) { control in
      models.withUnsafeMutableBufferPointer { models in
        poses.withUnsafeMutableBufferPointer { poses in
          points.withUnsafeMutableBytes { points in
            freedom.withUnsafeBufferPointer { freedom in
              priors.withUnsafeBufferPointer { priors in
                problem.photos.cameraOfPhoto.withUnsafeBufferPointer { photoCameras in
                  poseFreedom.withUnsafeBufferPointer { poseFreedom in
                    pointFreedom.withUnsafeBufferPointer { pointFreedom in
                      observations.withUnsafeBufferPointer { observations in
                        var bundle = ck_bundle(
                          cameras: models.baseAddress, camera_freedom: freedom.baseAddress,
                          camera_priors: priors.baseAddress, camera_count: models.count,
                          poses: poses.baseAddress, photo_cameras: photoCameras.baseAddress,
                          pose_freedom: poseFreedom.baseAddress, photo_count: poses.count,
                          points: points.baseAddress?.assumingMemoryBound(to: Double.self),
                          point_stride: MemoryLayout<SIMD3<Double>>.stride,
                          point_freedom: pointFreedom.baseAddress,
                          point_count: problem.points.count,
                          observations: observations.baseAddress,
                          observation_count: observations.count)
                        return ck_bundle_adjust(&bundle, &summary, &rawOptions, control)
                      }
                    }
                  }
                }
              }
            }
          }
        }
      }
    }
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
    var model = ck_camera_model(camera)
    var pose = ck_pose(cameraFromWorld)
    try withKernel(KernelControl()) { _ in
      ck_reprojection_jacobians(
        &residual, &byPose, &byPoint, &byCamera, &model, &pose, [point.x, point.y, point.z],
        [pixel.x, pixel.y])
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

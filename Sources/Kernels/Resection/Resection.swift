import CKernels
import SceneModel

/// Estimates the pose of a photo from 2D–3D correspondences: LO-RANSAC with P3P (Persson
/// and Nordberg, ECCV 2018).
package struct Resection: Sendable {
  /// RANSAC parameters.
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum reprojection error of an inlier in pixels. Chosen.
    package var maximumError = 8.0
    /// Maximum number of hypotheses. Chosen.
    package var maximumIterations = 1000
    /// Stops when the best hypothesis is optimal with this probability. Chosen.
    package var confidence = 0.99999
    /// With fewer inliers there is no pose. Chosen.
    package var minimumInliers = 15
    /// Seed of the random samples. Chosen: any value serves.
    package var seed: UInt64 = 0

    package init() {}
  }

  /// The estimated pose and its inliers.
  package struct Result: Sendable {
    /// The pose of the photo.
    package var cameraFromWorld: RigidTransform
    /// One value per correspondence.
    package var isInlier: [Bool]
    /// Number of inliers.
    package var inlierCount: Int
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The pose with the smallest sum of truncated squared reprojection errors of the correspondences
  /// of `pixels` and `points` (world frame).
  ///
  /// Throws `KernelError.degenerate` if no pose has enough inliers.
  package func run(
    pixels: [SIMD2<Double>], points: [SIMD3<Double>], camera: Camera,
    control: KernelControl = KernelControl()
  ) throws -> Result {
    guard pixels.count == points.count else {
      throw KernelError.invalidArgument("resection needs as many pixels as points")
    }
    var pose = ck_pose()
    var inliers = [UInt8](repeating: 0, count: pixels.count)
    var inlierCount = 0
    var camera = ck_camera(camera)
    var raw = ck_resection_options(
      maximum_error: options.maximumError, maximum_iterations: Int32(options.maximumIterations),
      confidence: options.confidence, minimum_inliers: Int32(options.minimumInliers),
      seed: options.seed)
    try withKernel(control) { control in
      withSpans(pixels, points) { pixels, points in
        ck_resect(&camera, pixels, points, &raw, control, &pose, &inliers, &inlierCount)
      }
    }
    return Result(
      cameraFromWorld: RigidTransform(pose), isInlier: inliers.map { $0 != 0 },
      inlierCount: inlierCount)
  }

  /// All poses that see three points along three rays of the camera frame (Persson and Nordberg,
  /// "Lambda Twist", ECCV 2018); none for degenerate input.
  package static func perspectiveThreePoint(
    rays: [SIMD3<Double>], points: [SIMD3<Double>]
  ) throws -> [RigidTransform] {
    guard rays.count == 3, points.count == 3 else {
      throw KernelError.invalidArgument("p3p needs three rays and three points")
    }
    var poses = [ck_pose](repeating: ck_pose(), count: 4)
    var count = 0
    let flatRays = rays.flatMap { [$0.x, $0.y, $0.z] }
    let flatPoints = points.flatMap { [$0.x, $0.y, $0.z] }
    try withKernel(KernelControl()) { _ in ck_p3p(flatRays, flatPoints, &poses, &count) }
    return poses.prefix(count).map { RigidTransform($0) }
  }
}

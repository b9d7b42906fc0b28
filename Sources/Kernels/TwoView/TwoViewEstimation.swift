import CKernels
import SceneModel

/// LO-RANSAC for essential matrices (five points) and fundamental matrices (seven points).
///
/// Points are at depth 1 of the viewing rays: `Camera.unproject(_:)`.
package struct TwoViewEstimation: Hashable, Codable, Sendable {
  /// Whether to estimate an essential matrix; otherwise a fundamental matrix.
  package var isCalibrated = true
  /// Maximum Sampson error of an inlier in units of the points. Chosen: `PairVerification` has a
  /// limit in pixels.
  package var maximumError = 1e-3
  /// Probability of finding the best model. Chosen.
  package var confidence = 0.9999
  /// Minimum number of samples to draw. Chosen.
  package var minimumIterations = 30
  /// Maximum number of samples to draw. Chosen: as in `PairVerification`.
  package var maximumIterations = 1000
  /// Seed of the random samples.
  package var seed: UInt64 = 0

  package init() {}

  /// The geometry with the best MSAC score; matches must be sorted by quality, the best first. Nil
  /// if no geometry is found.
  package func geometry(
    _ first: [SIMD2<Double>], _ second: [SIMD2<Double>], _ control: KernelControl
  ) throws -> TwoViewGeometry? {
    guard first.count == second.count else {
      throw KernelError.invalidArgument("the two lists of points differ in length")
    }
    var options = ck_two_view_options(
      is_calibrated: isCalibrated, maximum_error: maximumError, confidence: confidence,
      minimum_iterations: Int32(minimumIterations), maximum_iterations: Int32(maximumIterations),
      seed: seed)
    var result = ck_two_view_result()
    var inliers = [UInt8](repeating: 0, count: first.count)
    do {
      try withKernel(control) { control in
        withPairs(first, second) {
          ck_two_view_estimate($0, &options, control, &result, &inliers)
        }
      }
    } catch KernelError.degenerate {
      return nil
    }
    return TwoViewGeometry(result, inliers: inliers)
  }

  /// All essential matrices consistent with five matches (Nistér, PAMI 2004), each of norm 1.
  package static func essentialMatrices(
    _ first: [SIMD2<Double>], _ second: [SIMD2<Double>]
  ) throws -> [Matrix3] {
    try minimalSolutions(first, second, sampleSize: 5, ck_five_point)
  }

  /// All fundamental matrices consistent with seven matches, each of norm 1.
  package static func fundamentalMatrices(
    _ first: [SIMD2<Double>], _ second: [SIMD2<Double>]
  ) throws -> [Matrix3] {
    try minimalSolutions(first, second, sampleSize: 7, ck_seven_point)
  }

  private typealias Solver = (
    UnsafePointer<Double>?, UnsafePointer<Double>?, UnsafeMutablePointer<Double>?,
    UnsafeMutablePointer<Int>?
  ) -> ck_status

  private static func minimalSolutions(
    _ first: [SIMD2<Double>], _ second: [SIMD2<Double>], sampleSize: Int, _ solve: Solver
  ) throws -> [Matrix3] {
    guard first.count == sampleSize, second.count == sampleSize else {
      throw KernelError.invalidArgument("\(sampleSize) matches are needed")
    }
    var matrices = [Double](repeating: 0, count: 20 * 9)
    var count = 0
    try withKernel(KernelControl()) { _ in
      withCoordinates(first) { first in
        withCoordinates(second) { second in
          solve(first.baseAddress, second.baseAddress, &matrices, &count)
        }
      }
    }
    return (0..<count).map { Matrix3(rowMajor: Array(matrices[$0 * 9..<$0 * 9 + 9])) }
  }
}

/// Calls `body` with the interleaved coordinates of points.
func withCoordinates<Result>(
  _ points: [SIMD2<Double>], _ body: (UnsafeBufferPointer<Double>) -> Result
) -> Result {
  points.withUnsafeBytes { body($0.bindMemory(to: Double.self)) }
}

/// Calls `body` with the C representation of matches, valid only during the call.
func withPairs<Result>(
  _ first: [SIMD2<Double>], _ second: [SIMD2<Double>],
  _ body: (UnsafePointer<ck_point_pairs>) -> Result
) -> Result {
  withCoordinates(first) { firstPoints in
    withCoordinates(second) { secondPoints in
      var pairs = ck_point_pairs(
        first: firstPoints.baseAddress, second: secondPoints.baseAddress, count: first.count)
      return body(&pairs)
    }
  }
}

extension Matrix3 {
  fileprivate init(rowMajor e: [Double]) {
    self.init(rows: [e[0], e[1], e[2]], [e[3], e[4], e[5]], [e[6], e[7], e[8]])
  }
}

extension TwoViewGeometry {
  fileprivate init(_ result: ck_two_view_result, inliers: [UInt8]) {
    let m = result.matrix
    let (q, t) = (result.rotation, result.translation)
    self.init(
      matrix: Matrix3(rows: [m.0, m.1, m.2], [m.3, m.4, m.5], [m.6, m.7, m.8]),
      secondFromFirst: RigidTransform(
        rotation: Quaternion(x: q.0, y: q.1, z: q.2, w: q.3), translation: [t.0, t.1, t.2]),
      inliers: inliers.indices.filter { inliers[$0] != 0 },
      homographyInlierCount: result.homography_inlier_count, medianAngle: result.median_angle,
      iterations: Int(result.iterations))
  }
}

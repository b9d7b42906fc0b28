import CKernels
import SceneModel

/// Estimates the photos' rotations that best agree with relative ones: L1 minimization, then a
/// robust loss (Chatterjee and Govindu, "Efficient and robust large-scale rotation averaging", ICCV
/// 2013).
package struct RotationAveraging: Sendable {
  /// Solver parameters.
  package struct Options: Hashable, Codable, Sendable {
    /// Iterations that minimize the sum of angles (L1). Chosen.
    package var absoluteIterations = 20
    /// Iterations with the robust loss. Chosen.
    package var robustIterations = 30
    /// The scale of the robust loss is three times the median error, clamped to these bounds in
    /// degrees. Chosen.
    package var minimumScaleDegrees = 0.3
    package var maximumScaleDegrees = 5.0
    /// Stops when the mean change of a rotation falls below this, in radians. Chosen.
    package var tolerance = 1e-6

    package init() {}
  }

  /// The estimated rotations and their residuals.
  package struct Result: Sendable {
    /// `cameraFromWorld` by photo.
    package var rotations: [Quaternion]
    /// The angular residual of each pair in radians.
    package var errors: [Double]
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Starts from `start`, one rotation per photo. Photo 0 is fixed.
  ///
  /// Throws `KernelError.degenerate` if the pairs don't connect all photos.
  package func run(
    _ pairs: [RelativeRotation], start: [Quaternion], control: KernelControl = KernelControl()
  ) throws -> Result {
    var rotations = start.map { SIMD4($0.x, $0.y, $0.z, $0.w) }
    var errors = [Double](repeating: 0, count: pairs.count)
    let raw = pairs.map {
      ck_relative_rotation(
        first: $0.first, second: $0.second, qx: $0.rotation.x, qy: $0.rotation.y,
        qz: $0.rotation.z, qw: $0.rotation.w, weight: $0.weight)
    }
    var rawOptions = ck_rotation_averaging_options(
      absolute_iterations: Int32(options.absoluteIterations),
      robust_iterations: Int32(options.robustIterations),
      minimum_scale: options.minimumScaleDegrees * .pi / 180,
      maximum_scale: options.maximumScaleDegrees * .pi / 180, tolerance: options.tolerance)
    try withKernel(control) { control in
      rotations.withMutableSpan {
        ck_average_rotations(raw, raw.count, &rawOptions, control, $0, &errors)
      }
    }
    return Result(
      rotations: rotations.map { Quaternion(x: $0.x, y: $0.y, z: $0.z, w: $0.w) },
      errors: errors)
  }
}

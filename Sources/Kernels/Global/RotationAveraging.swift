import CKernels
import SceneModel

/// A rotation measured between two photos: `R_second = rotation · R_first`.
package struct RelativeRotation: Hashable, Sendable {
  package var first: Int32
  package var second: Int32
  package var rotation: Quaternion
  /// Trust in it, above 0.
  package var weight: Double

  package init(first: Int32, second: Int32, rotation: Quaternion, weight: Double = 1) {
    (self.first, self.second, self.rotation, self.weight) = (first, second, rotation, weight)
  }
}

/// Finds the rotations of photos that agree best with relative ones: least sum of angles, then a robust
/// loss (Chatterjee and Govindu, "Efficient and robust large-scale rotation averaging", ICCV 2013).
package struct RotationAveraging: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Iterations that minimise the sum of angles.
    package var absoluteIterations = 20
    /// Iterations with the robust loss.
    package var robustIterations = 30
    /// The scale of the robust loss is three times the median error, within these degrees.
    package var smallestScaleDegrees = 0.3
    package var largestScaleDegrees = 5.0
    /// Mean change of a rotation below which it ends, in radians.
    package var tolerance = 1e-6

    package init() {}
  }

  package struct Result: Sendable {
    /// `cameraFromWorld` by photo.
    package var rotations: [Quaternion]
    /// By how many radians each pair disagrees.
    package var errors: [Double]
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Begins with `start`, one rotation a photo. Photo 0 keeps its own.
  ///
  /// Throws `KernelError.degenerate` where the pairs don't connect all photos.
  package func run(
    _ pairs: [RelativeRotation], start: [Quaternion], control: KernelControl = KernelControl()
  ) throws -> Result {
    var rotations = start.flatMap { [$0.x, $0.y, $0.z, $0.w] }
    var errors = [Double](repeating: 0, count: pairs.count)
    let raw = pairs.map {
      ck_relative_rotation(
        first: $0.first, second: $0.second, qx: $0.rotation.x, qy: $0.rotation.y,
        qz: $0.rotation.z, qw: $0.rotation.w, weight: $0.weight)
    }
    var rawOptions = ck_rotation_averaging_options(
      absolute_iterations: Int32(options.absoluteIterations),
      robust_iterations: Int32(options.robustIterations),
      smallest_scale: options.smallestScaleDegrees * .pi / 180,
      largest_scale: options.largestScaleDegrees * .pi / 180, tolerance: options.tolerance)
    try withKernel(control) { control in
      ck_average_rotations(
        &rotations, start.count, &errors, raw, raw.count, &rawOptions, control)
    }
    return Result(
      rotations: start.indices.map { index in
        let q = rotations[4 * index..<4 * index + 4]
        return Quaternion(
          x: q[q.startIndex], y: q[q.startIndex + 1], z: q[q.startIndex + 2],
          w: q[q.startIndex + 3])
      },
      errors: errors)
  }
}

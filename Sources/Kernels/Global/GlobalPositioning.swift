import CKernels
import SceneModel

/// The direction in the world in which a photo sees a point.
package struct PointDirection: Hashable, Sendable {
  package var photo: Int32
  package var point: Int32
  /// Of length 1.
  package var direction: SIMD3<Double>

  package init(photo: Int32, point: Int32, direction: SIMD3<Double>) {
    (self.photo, self.point, self.direction) = (photo, point, direction)
  }
}

/// Finds the places of cameras and points together from the directions between them (Pan et al.,
/// "Global structure-from-motion revisited", ECCV 2024).
package struct GlobalPositioning: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    package var maximumIterations = 100
    /// Where the Huber loss turns from square to linear; residuals are about sines of angles.
    package var huberWidth = 0.1
    /// Relative decrease of the cost below which it ends.
    package var functionTolerance = 1e-5

    package init() {}
  }

  package struct Result: Sendable {
    /// Camera centres by photo and points, in one frame of any place and unit.
    package var centers: [SIMD3<Double>]
    package var points: [SIMD3<Double>]
    package var initialCost: Double
    package var finalCost: Double
    package var iterations: Int
    package var hasConverged: Bool
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Begins with the given places. `directions` are grouped by point, ascending.
  package func run(
    _ directions: [PointDirection], centers: [SIMD3<Double>], points: [SIMD3<Double>],
    control: KernelControl = KernelControl()
  ) throws -> Result {
    var rawCenters = centers.flatMap { [$0.x, $0.y, $0.z] }
    var rawPoints = points.flatMap { [$0.x, $0.y, $0.z] }
    let raw = directions.map {
      ck_direction(
        photo: $0.photo, point: $0.point, x: $0.direction.x, y: $0.direction.y, z: $0.direction.z)
    }
    var summary = ck_positioning_summary()
    var rawOptions = ck_positioning_options(
      max_iterations: Int32(options.maximumIterations), huber_width: options.huberWidth,
      function_tolerance: options.functionTolerance)
    try withKernel(control) { control in
      ck_position_globally(
        &rawCenters, centers.count, &rawPoints, points.count, raw, raw.count, &summary,
        &rawOptions, control)
    }
    func vectors(_ values: [Double]) -> [SIMD3<Double>] {
      stride(from: 0, to: values.count, by: 3).map { [values[$0], values[$0 + 1], values[$0 + 2]] }
    }
    return Result(
      centers: vectors(rawCenters), points: vectors(rawPoints), initialCost: summary.initial_cost,
      finalCost: summary.final_cost, iterations: Int(summary.iterations),
      hasConverged: summary.converged)
  }
}

import CKernels

/// Global positioning: estimates camera centers and points together from the directions between
/// them (Pan et al., "Global structure-from-motion revisited", ECCV 2024).
package struct GlobalPositioning: Sendable {
  /// Solver parameters.
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum number of Levenberg–Marquardt iterations. Chosen: the default of GLOMAP (Pan et al.
    /// 2024).
    package var maximumIterations = 100
    /// Residual at which the Huber loss changes from quadratic to linear; residuals approximate
    /// sines of angles. Chosen: the default of GLOMAP.
    package var huberWidth = 0.1
    /// Stops when the relative decrease of the cost falls below this. Chosen: the default of
    /// GLOMAP.
    package var functionTolerance = 1e-5

    package init() {}
  }

  /// The estimated positions, with statistics of the solver.
  package struct Result: Sendable {
    /// Camera centers by photo, and points; their position and scale are arbitrary (gauge freedom).
    package var centers: [SIMD3<Double>]
    package var points: [SIMD3<Double>]
    package var initialCost: Double
    package var finalCost: Double
    package var iterations: Int
    package var hasConverged: Bool
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Starts from the given positions. `directions` are grouped by point, ascending.
  package func run(
    _ directions: [PointDirection], centers: [SIMD3<Double>], points: [SIMD3<Double>],
    control: KernelControl = KernelControl()
  ) throws -> Result {
    var (newCenters, newPoints) = (centers, points)
    let raw = directions.map {
      ck_direction(
        photo: $0.photo, point: $0.point, x: $0.direction.x, y: $0.direction.y, z: $0.direction.z)
    }
    var summary = ck_positioning_summary()
    var rawOptions = ck_positioning_options(
      maximum_iterations: Int32(options.maximumIterations), huber_width: options.huberWidth,
      function_tolerance: options.functionTolerance)
    try withKernel(control) { control in
      newCenters.withMutableSpan { centers in
        newPoints.withMutableSpan { points in
          ck_position_globally(raw, raw.count, &rawOptions, control, centers, points, &summary)
        }
      }
    }
    return Result(
      centers: newCenters, points: newPoints, initialCost: summary.initial_cost,
      finalCost: summary.final_cost, iterations: Int(summary.iterations),
      hasConverged: summary.converged)
  }
}

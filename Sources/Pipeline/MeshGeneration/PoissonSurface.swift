import Foundation
import Kernels
import SceneModel

/// Reconstructs a closed surface from a downsampled cloud by screened Poisson reconstruction
/// (Kazhdan and Hoppe, ACM TOG 2013), with cells about as large as the sample spacing.
struct PoissonSurface {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum octree depth. Each level quadruples time and memory. Chosen.
    var maximumDepth = 10
    /// Minimum depth, also for a cloud of unknown spacing. Chosen.
    var minimumDepth = 5
    /// Side of the solved cube relative to the cloud's largest extent. Chosen: the default of the
    /// code of Kazhdan and Hoppe 2013.
    var scale = 1.1
    /// Minimum number of points. Chosen.
    var minimumPoints = 20
    /// Memory of the solver, in bytes; cells are larger if it would need more.
    var maximumBytes = Int.max

    init() {}
  }

  var options = Options()

  /// The surface and the side of its smallest cells. `spacing` is the sample spacing; both are in
  /// world units. Throws `PipelineError.noSurface`.
  func run(
    _ cloud: PointCloud, spacing: Double, _ context: StageContext
  ) throws -> (mesh: Mesh, cell: Double) {
    // Measured: the shares of the time on boot and orbit.
    let solution = try solution(of: cloud, spacing: spacing, context.part(from: 0, to: 0.75))
    return try surface(of: solution, cloud, context.control.part(from: 0.75, to: 1))
  }

  /// The surface of a solution for a cloud. Returns and throws like `run`.
  func surface(
    of solution: PoissonSolution, _ cloud: PointCloud, _ control: KernelControl
  ) throws -> (mesh: Mesh, cell: Double) {
    let mesh = try solution.surface(control)
    guard !mesh.triangles.isEmpty else {
      throw PipelineError.noSurface(reason: "no surface fits the \(cloud.count) points.")
    }
    return (mesh, options.scale * extent(of: cloud) / exp2(Double(solution.depth)))
  }

  /// The solved system, whose surface is that of the points. Throws like `run`.
  func solution(
    of cloud: PointCloud, spacing: Double, _ context: StageContext
  ) throws -> PoissonSolution {
    guard cloud.count >= options.minimumPoints, cloud.normals.count == cloud.count else {
      throw PipelineError.noSurface(reason: "only \(cloud.count) points were found.")
    }
    var solver = PoissonReconstruction()
    solver.scale = options.scale
    solver.maximumBytes = options.maximumBytes
    solver.depth = depth(extent: extent(of: cloud), spacing: spacing)
    let solution = try solve(cloud, solver, context.control)
    context.notes.record("poissonDepth", Double(solution.depth))
    if solution.depth < solver.depth {
      let factor = 1 << (solver.depth - solution.depth)
      context.notes.warn(
        "The surface has cells \(factor) times as large as the points allow, "
          + "because it may take \(options.maximumBytes >> 20) MB of memory. Use a machine "
          + "with more.")
    }
    return solution
  }

  private func solve(
    _ cloud: PointCloud, _ solver: PoissonReconstruction, _ control: KernelControl
  ) throws -> PoissonSolution {
    do {
      return try solver.solve(positions: cloud.positions, normals: cloud.normals, control)
    } catch let error as KernelError where error != .outOfMemory {
      throw PipelineError.noSurface(
        reason: "no surface fits the \(cloud.count) points (\(error)).")
    }
  }

  /// The largest extent of the points along an axis, in world units.
  private func extent(of cloud: PointCloud) -> Double {
    Mesh(positions: cloud.positions).bounds.map { Double(($0.max - $0.min).max()) } ?? 0
  }

  /// The depth at which a cell is 1 to 1.5 (at most 2) spacings wide.
  func depth(extent: Double, spacing: Double) -> Int {
    guard extent > 0, spacing > 0, (extent / spacing).isFinite else { return options.minimumDepth }
    // Fractions of 0.6 or more are rounded up.
    let exact = log2(options.scale * extent / spacing)
    return max(options.minimumDepth, min(options.maximumDepth, Int((exact + 0.4).rounded(.down))))
  }
}

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
    guard let bounds = Mesh(positions: cloud.positions).bounds,
      cloud.count >= options.minimumPoints,
      cloud.normals.count == cloud.count
    else {
      throw PipelineError.noSurface(reason: "only \(cloud.count) points were found.")
    }
    var solver = PoissonReconstruction()
    solver.scale = options.scale
    solver.maximumBytes = options.maximumBytes
    let extent = Double((bounds.max - bounds.min).max())
    solver.depth = depth(extent: extent, spacing: spacing)
    let (mesh, depth) = try surface(of: cloud, solver, context.control)
    guard !mesh.triangles.isEmpty else {
      throw PipelineError.noSurface(reason: "no surface fits the \(cloud.count) points.")
    }
    context.notes.record("poissonDepth", Double(depth))
    if depth < solver.depth {
      context.notes.warn(
        "The surface has cells \(1 << (solver.depth - depth)) times as large as the points allow, "
          + "because it may take \(options.maximumBytes >> 20) MB of memory. Use a machine "
          + "with more.")
    }
    return (mesh, options.scale * extent / exp2(Double(depth)))
  }

  private func surface(
    of cloud: PointCloud, _ solver: PoissonReconstruction, _ control: KernelControl
  ) throws -> (mesh: Mesh, depth: Int) {
    do {
      return try solver.surface(positions: cloud.positions, normals: cloud.normals, control)
    } catch let error as KernelError where error != .outOfMemory {
      throw PipelineError.noSurface(
        reason: "no surface fits the \(cloud.count) points (\(error)).")
    }
  }

  /// The depth at which a cell is 1 to 1.5 (at most 2) spacings wide.
  func depth(extent: Double, spacing: Double) -> Int {
    guard extent > 0, spacing > 0, (extent / spacing).isFinite else { return options.minimumDepth }
    // Fractions of 0.6 or more are rounded up.
    let exact = log2(options.scale * extent / spacing)
    return max(options.minimumDepth, min(options.maximumDepth, Int((exact + 0.4).rounded(.down))))
  }
}

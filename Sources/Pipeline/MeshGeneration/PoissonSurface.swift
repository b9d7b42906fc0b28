import Foundation
import Kernels
import SceneModel

/// Makes a closed surface of an averaged cloud by screened Poisson reconstruction (Kazhdan and
/// Hoppe, ACM TOG 2013), with cells about as large as the samples are apart.
struct PoissonSurface {
  struct Options: Hashable, Codable, Sendable {
    /// Levels of the octree at most. Each one costs four times the time and memory.
    var maximumDepth = 10
    var minimumDepth = 5
    /// Side of the solved cube in units of the cloud's largest extent.
    var scale = 1.1

    init() {}
  }

  var options = Options()

  /// The surface and the side of its finest cells, in world units, as is `spacing`, the distance of
  /// the samples.
  func run(
    _ cloud: PointCloud, spacing: Double, _ context: StageContext
  ) throws -> (mesh: Mesh, cell: Double) {
    guard let bounds = Mesh(positions: cloud.positions).bounds, cloud.count >= 20,
      cloud.normals.count == cloud.count
    else {
      throw PipelineError.noSurface(reason: "only \(cloud.count) points were found.")
    }
    var solver = PoissonReconstruction()
    solver.scale = options.scale
    let extent = Double((bounds.max - bounds.min).max())
    let depth = depth(extent: extent, spacing: spacing)
    var failure = ""
    // The solver gives up on rare inputs ("failed to close loop"); a coarser tree avoids them.
    for coarser in 0..<3 where depth - coarser >= 2 {
      solver.depth = depth - coarser
      do {
        let surface = try solver.surface(
          positions: cloud.positions, normals: cloud.normals, context.control)
        guard !surface.mesh.triangles.isEmpty else { continue }
        context.notes.count("poissonDepth", Double(solver.depth))
        return (surface.mesh, options.scale * extent / exp2(Double(solver.depth)))
      } catch let error as KernelError where error != .outOfMemory {
        failure = " (\(error))"
      }
    }
    throw PipelineError.noSurface(
      reason: "no surface fits the \(cloud.count) points\(failure).")
  }

  /// The depth at which a cell is 1 to 1.5 (at most 2) spacings wide.
  func depth(extent: Double, spacing: Double) -> Int {
    guard extent > 0, spacing > 0, (extent / spacing).isFinite else { return options.minimumDepth }
    let exact = log2(options.scale * extent / spacing)
    return max(options.minimumDepth, min(options.maximumDepth, Int((exact + 0.4).rounded(.down))))
  }
}

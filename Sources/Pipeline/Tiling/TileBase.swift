import Kernels
import SceneModel

/// What all tiles of a scene have in common.
struct TileBase {
  /// Of the thinned cloud.
  let samples: SurfaceSamples
  /// The coarse levels, which are solved for the whole scene.
  let solution: PoissonSolution
  let grid: TileGrid
  /// The typical footprint of all points, in world units.
  let footprint: Float
  /// Side of the smallest voxels in which the points are averaged, in world units.
  let voxelSize: Double

  /// Depth of the octree in tiles.
  func depth(_ poisson: PoissonSurface) -> Int {
    var poisson = poisson
    // Limit: that of the kernel.
    poisson.options.maximumDepth = 14
    let extent = solution.cube.side / poisson.options.scale
    return max(solution.depth, poisson.depth(extent: extent, spacing: voxelSize))
  }
}

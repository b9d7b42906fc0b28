import Foundation
import Kernels
import SceneModel

/// What all tiles of a scene have in common.
struct TileBase {
  /// Of the thinned cloud.
  let samples: SurfaceSamples
  /// The coarse levels, which are solved for the whole scene.
  let solution: PoissonSolution
  let grid: TileGrid
  /// Depth of the octree in tiles.
  let depth: Int
  /// The typical footprint of all points, in world units.
  let footprint: Float
  /// The footprint of the coarsest samples, in world units.
  let coarsestFootprint: Float
  /// Side of the smallest voxels in which the points are averaged, in world units.
  let voxelSize: Double

  /// Spacing of the samples, or half a cell where cells are larger, in world units.
  var spacing: Double { max(voxelSize, grid.cube.side / exp2(Double(depth)) / 2) }
}

import Foundation
import Kernels
import SceneModel

/// What all tiles of a scene have in common.
struct TileBase {
  /// What the scene stands on.
  let support: SupportPlane?
  /// The footprint up to which coarser samples may be farther from others, in world units.
  let coarsestFootprint: Float
  /// The coarse levels, which are solved for the whole scene.
  let solution: PoissonSolution
  let grid: TileGrid
  /// For each view, the cells of the grid's level around its points; nil without points.
  let viewBoxes: [CellBox?]
  /// Depth of the octree in tiles.
  let depth: Int
  /// The typical footprint of all points, in world units.
  let footprint: Float
  /// Side of the smallest voxels in which the points are averaged, in world units.
  let voxelSize: Double

  /// Spacing of the samples, or half a cell where cells are larger, in world units.
  var spacing: Double { max(voxelSize, grid.cube.side / exp2(Double(depth)) / 2) }

  /// The tiles of a block, so that all blocks are expected to have about the same amount of work.
  func tiles(of block: Block) -> [Int] { block.indices(ofWeights: works) }

  /// The expected work of each tile, as a number of points: the work with its points, and with each
  /// view that has points there.
  var works: [Int] {
    let perView =
      Self.workOfView * Double(grid.pointCounts.reduce(0, +)) / Double(max(1, viewBoxes.count))
    return zip(grid.boxes, grid.pointCounts).map { box, points in
      points + Int(perView * Double(viewBoxes.count { $0.map(box.overlaps) == true }))
    }
  }

  /// The work with a view in a tile, as a share of the points that views have on average. Measured:
  /// 0.23 s for a view with 26,600 points and 44 s for a million points, on the town of 1000 photos
  /// (`67da71d`).
  private static let workOfView = 0.2
}

extension TileBase: UnitValue {
  private struct Record: LargeUnitValue {
    var support: SupportPlane?
    var coarsestFootprint: Float
    var solution: Data
    var grid: TileGrid
    var viewBoxes: [CellBox?]
    var depth: Int
    var footprint: Float
    var voxelSize: Double
  }

  init?(unit: Data) {
    guard let record = Record(unit: unit) else { return nil }
    let solution = record.solution.withUnsafeBytes {
      try? PoissonSolution(encoded: $0, for: record.grid.whole, KernelControl())
    }
    guard let solution else { return nil }
    self.init(
      support: record.support, coarsestFootprint: record.coarsestFootprint, solution: solution,
      grid: record.grid, viewBoxes: record.viewBoxes, depth: record.depth,
      footprint: record.footprint, voxelSize: record.voxelSize)
  }

  func unitData() throws -> Data {
    try Record(
      support: support, coarsestFootprint: coarsestFootprint,
      solution: Data(try solution.encoded(for: grid.whole)), grid: grid, viewBoxes: viewBoxes,
      depth: depth, footprint: footprint, voxelSize: voxelSize
    ).unitData()
  }
}

import Foundation
import Kernels
import SceneModel

/// The surfaces of tiles, from solutions that are made once and stored.
struct TileSurfaces {
  let tiling: Tiling
  let base: TileBase
  let views: FusedViews
  let store: TileStore
  /// The samples of the whole scene, where those near a tile are not stored.
  let samples: () throws -> SurfaceSamples

  var count: Int { base.grid.boxes.count }

  /// Solves a tile, unless that was done. Throws `OutputError` if it can't be stored.
  @discardableResult
  func solve(_ tile: Int, _ context: StageContext) throws -> SolvedTile {
    try store.solved(tile) {
      let solved = try tiling.solve(
        try points(of: tile), near: try nearbySamples(tile, context.control), of: base, context)
      guard let (solution, samples) = solved else { return SolvedTile() }
      let box = base.grid.boxes[tile].dilated(by: tiling.halo(base))
      return SolvedTile(samples: samples, solution: Data(try solution.encoded(for: box)))
    }
  }

  /// Stores the samples of the scene near each tile, for other processes. Throws `OutputError`.
  func storeSamples(of samples: SurfaceSamples, _ control: KernelControl) throws {
    let (store, corners) = (store, (0..<count).map { tiling.corners(of: $0, base) })
    let blocks = try SampleBlocks(samples, reach: tiling.options.sampleReach, control)
    _ = try control.parallelMap(count) { tile in
      try store.samples(tile) { NearbySamples(of: blocks, between: corners[tile]) }
    }
  }

  private func nearbySamples(_ tile: Int, _ control: KernelControl) throws -> NearbySamples {
    try store.samples(tile) {
      let blocks = try SampleBlocks(
        try samples(), reach: tiling.options.sampleReach, control.part(from: 0, to: 0))
      return NearbySamples(of: blocks, between: tiling.corners(of: tile, base))
    }
  }

  /// The points in and around a tile, in the order of the views.
  private func points(of tile: Int) throws -> PointCloud {
    let (cube, depth) = (base.grid.cube, base.grid.depth)
    let reach = base.grid.boxes[tile].dilated(by: tiling.reach(base))
    var result = PointCloud()
    for (view, box) in base.viewBoxes.enumerated() where box.map(reach.overlaps) == true {
      let points = try views.points(view)
      result.append(
        points.filtered(
          by: points.positions.map { cube.cell(of: $0, depth: depth).map(reach.contains) == true }))
    }
    return result
  }

  /// The surface of a tile, with the vertices of its neighbors at the seams, and the photos that
  /// see it; nil if it has none. `observed` is all that the photos observe.
  func surface(
    _ tile: Int, observed: PointCloud, _ context: StageContext
  ) throws -> (mesh: Mesh, photos: Set<UInt16>)? {
    let (boxes, quiet) = (base.grid.boxes, context.part(from: 0, to: 0))
    let reach = boxes[tile].dilated(by: tiling.halo(base))
    let solved = try solve(tile, quiet)
    guard let solution = try solution(solved, for: reach, quiet.control) else { return nil }
    for other in boxes.indices where other != tile && boxes[other].overlaps(reach) {
      let neighbor = try self.solution(try solve(other, quiet), for: reach, quiet.control)
      guard let neighbor else { continue }
      try solution.adopt(neighbor, below: base.solution.depth, in: boxes[other], quiet.control)
    }
    let mesh = try tiling.surface(
      tile, solution, samples: solved.samples, of: base, scene: observed, context)
    return mesh.map { ($0, Set(solved.samples.photoIndices)) }
  }

  /// What the surface in a box depends on; nil if a tile has none.
  private func solution(
    _ tile: SolvedTile, for box: CellBox, _ control: KernelControl
  ) throws -> PoissonSolution? {
    guard !tile.solution.isEmpty else { return nil }
    return try tile.solution.withUnsafeBytes {
      try PoissonSolution(encoded: $0, for: box, control)
    }
  }
}

import Foundation
import Kernels
import SceneModel

/// Reconstructs the surface of a scene in tiles, each from all points there, in memory for one
/// tile. Where tiles meet they have the same vertices, to the last bit.
///
/// The coarse levels of the octree are solved once, for the thinned cloud of the scene; the finer
/// ones for each tile and its surroundings. Near seams, a tile takes the values of the tile that
/// they belong to; all that follows is local, and done for the tile and a halo that is wider than
/// what it depends on.
package struct Tiling {
  /// Parameters of tiles.
  package struct Options: Hashable, Codable, Sendable {
    /// Points of a tile, at most. Chosen: tiles of several hundred thousand triangles, which
    /// viewers and texturing cope with.
    var maximumPoints = 500_000
    /// A hole or component with an extent below this share of the halo is seen as a whole by all
    /// tiles that it is part of. Chosen.
    var localShare = 0.25
    /// Cells of the first level below the base by which a tile is solved beyond its halo. Chosen:
    /// two bricks, over which the error of missing samples decays.
    var solverCells = 16
    /// Greatest depth of the boxes' lattice. Chosen: 128 cells per axis.
    var latticeDepth = 7
    /// A point belongs to the scene if it is within this many voxels of one of its samples. Chosen.
    var sampleReach = 3.0
    /// Side of a tile's textures in texels, halved while the photos have less detail. Chosen: what
    /// all viewers support.
    var textureSide = 4096
    /// Textures of a tile, at most. Chosen.
    var maximumAtlases = 4

    package init() {}
  }

  let options: Options
  let meshing: MeshGeneration
  let reconstruction: Reconstruction
  let silhouettes: Silhouettes?

  /// What all tiles have in common; `system` is that of the thinned cloud of the scene, and `views`
  /// has all points.
  func base(
    _ system: SurfaceSystem, _ views: FusedViews, _ context: StageContext
  ) throws -> TileBase {
    let solution = system.solution
    var counts = CellCounts(
      cube: solution.cube, depth: min(options.latticeDepth, solution.depth))
    var (footprints, viewBoxes): ([Float], [CellBox?]) = ([], [])
    for view in 0..<views.count {
      try context.control.step(Double(view) / Double(views.count))
      let points = try views.points(view)
      viewBoxes.append(counts.add(points.positions))
      if let median = points.medianFootprint { footprints.append(median) }
    }
    guard let footprint = footprints.quantile(0.5) else {
      throw PipelineError.noSurface(reason: "the point cloud is empty.")
    }
    let voxelSize = Double(footprint) * meshing.options.downsampling.voxelFootprints
    var poisson = PoissonSurface(options: meshing.options.poisson)
    // Limit: the greatest depth of the kernel.
    poisson.options.maximumDepth = 14
    let depth = poisson.depth(
      extent: solution.cube.side / poisson.options.scale, spacing: voxelSize)
    return TileBase(
      support: system.samples.support,
      coarsestFootprint: system.samples.cloud.footprints.quantile(0.99) ?? footprint,
      solution: solution,
      grid: TileGrid(counts, maximumPoints: options.maximumPoints),
      viewBoxes: viewBoxes, depth: max(solution.depth, depth), footprint: footprint,
      voxelSize: voxelSize)
  }

  /// Cells of the lattice by which the surface of a tile is made beyond its box: beyond what is
  /// seen as a whole, the edges over which boundaries are smoothed.
  func halo(_ base: TileBase) -> Int {
    let boundary = meshing.options.trimming.boundary
    let cells = Double(boundary.steps + boundary.reach) / (1 - options.localShare)
    return max(1, Int((cells / exp2(Double(base.depth - base.grid.depth))).rounded(.up)))
  }

  /// Cells of the lattice by which the points of a tile reach beyond its box.
  func reach(_ base: TileBase) -> Int {
    let finer = Double(base.solution.depth + 1 - base.grid.depth)
    return halo(base) + max(1, Int((Double(options.solverCells) / exp2(finer)).rounded(.up)))
  }

  /// The solution of a tile and of its surroundings, before seams are adjusted, and its samples;
  /// nil if there are too few. `points` are those in and around it, `scene` the samples there.
  func solve(
    _ points: PointCloud, near scene: NearbySamples, of base: TileBase, _ context: StageContext
  ) throws -> (solution: PoissonSolution, samples: PointCloud)? {
    let isKept = try scene.reach(points.positions, context.control.part(from: 0, to: 0.1))
    let downsampling = VoxelDownsampling(options: meshing.options.downsampling)
    let averaged = try downsampling.run(
      points, keeping: isKept, footprint: base.footprint, context.part(from: 0.1, to: 0.2))
    var samples = averaged.cloud
    try downsampling.removeOutliers(
      from: &samples, voxelSize: averaged.voxelSize, coarsest: base.coarsestFootprint,
      context.control.part(from: 0.2, to: 0.3))
    guard samples.count >= meshing.options.poisson.minimumPoints else { return nil }
    let solution = try base.solution.refined(
      positions: samples.positions, normals: samples.normals, depth: base.depth,
      context.control.part(from: 0.3, to: 1))
    return (solution, samples)
  }

  /// The corners of the box that has all points that a tile is solved from.
  func corners(of tile: Int, _ base: TileBase) -> (low: SIMD3<Double>, high: SIMD3<Double>) {
    base.grid.corners(of: base.grid.boxes[tile].dilated(by: reach(base)))
  }
}

extension Tiling {
  /// The final surface in the box of a tile, with normals and colors, from its solution with the
  /// values of its neighbors; nil if there is none. `scene` is all that the photos observe.
  func surface(
    _ tile: Int, _ solution: PoissonSolution, samples: PointCloud, of base: TileBase,
    scene: PointCloud, _ context: StageContext
  ) throws -> Mesh? {
    let box = base.grid.boxes[tile]
    let part = part(around: box, base)
    let solved = try solution.surface(
      in: box.dilated(by: halo(base)), context.control.part(from: 0, to: 0.2))
    var trimming = SurfaceTrimming(options: meshing.options.trimming)
    trimming.options.holeFilling.fillsLarge = false
    let trimmed = try trimming.run(
      solved, samples: samples, scene: scene, spacing: base.spacing,
      support: base.support, silhouettes: silhouettes, part: part, reconstruction,
      context.part(from: 0.2, to: 0.8))
    guard !trimmed.triangles.isEmpty else { return nil }
    var mesh = try MeshCleaning(options: meshing.options.cleaning).run(
      trimmed, samples: samples, part: part, context.part(from: 0.8, to: 1))
    mesh.triangles = mesh.triangles.filter { triangle in
      let (a, b, c) = mesh.corners(of: triangle)
      // In double precision the sum is exact, in whatever order.
      let sum = SIMD3<Double>(a) + SIMD3<Double>(b) + SIMD3<Double>(c)
      return box.contains(base.grid.cell(nearest: sum / 3))
    }
    return mesh.triangles.isEmpty ? nil : mesh.withoutUnusedVertices()
  }

  /// What stands for properties of the whole surface in a tile and its halo.
  private func part(around box: CellBox, _ base: TileBase) -> SurfacePart {
    let (halo, cell) = (halo(base), base.grid.cellSize)
    let (low, high) = base.grid.corners(of: box.dilated(by: halo))
    let local = options.localShare * Double(halo) * cell
    return SurfacePart(
      low: low, high: high, rim: 2 * base.spacing, minimumComponentArea: local * local,
      extent: Float(local / meshing.options.trimming.holeFilling.smallShare),
      freeSpaceCell: freeSpaceCell(base))
  }

  /// The same for all tiles: the largest part of a lattice cell of which none has too many.
  private func freeSpaceCell(_ base: TileBase) -> Double {
    let (halo, cell) = (halo(base), base.grid.cellSize)
    let largest =
      base.grid.boxes.map { box in
        let dilated = box.dilated(by: halo)
        return Double((dilated.high &- dilated.low).max()) * cell
      }.max() ?? cell
    // One cell less than the limit, for rounding.
    let smallest = max(
      meshing.options.trimming.cellSpacings * base.spacing,
      largest / Double(FreeSpace.maximumCells - 1))
    return cell / max(1, (cell / smallest).rounded(.down))
  }
}

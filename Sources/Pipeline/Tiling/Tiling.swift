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
    /// Points of a tile, at most. Chosen: about as many triangles, which viewers and texturing cope
    /// with.
    var maximumPoints = 500_000
    /// Finest cells by which the surface is made beyond a tile. Chosen: more than the 80 edges over
    /// which boundaries are smoothed.
    var haloCells = 128
    /// A hole or component with an extent below this share of the halo is seen as a whole by all
    /// tiles that it is part of. Chosen.
    var localShare = 0.25
    /// Cells of the first level below the base by which a tile is solved beyond its halo. Chosen:
    /// two bricks, over which the error of missing samples decays.
    var solverCells = 16
    /// Greatest depth of the boxes' lattice. Chosen: 128 cells per axis.
    var latticeDepth = 7
    /// Side of the free-space cells, in spacings. Chosen: as `SurfaceTrimming`.
    var freeSpaceSpacings = 2.0
    /// A point belongs to the scene if it is within this many voxels of one of its samples. Chosen.
    var sampleReach = 3.0
    /// Side of a tile's textures in texels, halved while the photos have less detail. Chosen: what
    /// all viewers support.
    var textureSide = 4096
    /// Textures of a tile, at most. Chosen.
    var maximumAtlases = 4
    /// Triangles of the rest of the scene that block the photos' view of a tile. Chosen: as in
    /// `TextureMapping`.
    var occluderTriangles = 100_000

    package init() {}
  }

  let options: Options
  let meshing: MeshGeneration
  let reconstruction: Reconstruction
  let silhouettes: Silhouettes?

  /// What all tiles have in common; `cloud` is the thinned cloud of the scene.
  func base(
    _ cloud: PointCloud, support: SupportPlane?, _ views: FusedViews, _ context: StageContext
  ) throws -> TileBase {
    let samples = try meshing.samples(
      of: cloud, reconstruction, silhouettes: silhouettes, support: support,
      context.part(from: 0, to: 0.3))
    var poisson = PoissonSurface(options: meshing.options.poisson)
    poisson.options.maximumDepth = meshing.options.maximumDepth
    let solution = try poisson.solution(
      of: samples.cloud, spacing: samples.voxelSize, context.part(from: 0.3, to: 0.8))
    let latticeDepth = min(options.latticeDepth, solution.depth)
    var counts = CellCounts(cube: solution.cube, depth: latticeDepth)
    var footprints: [Float] = []
    for view in 0..<views.count {
      let points = try views.points(view)
      counts.add(points.positions)
      if let median = points.medianFootprint { footprints.append(median) }
      try context.control.step(0.8 + 0.2 * Double(view) / Double(views.count))
    }
    guard let footprint = footprints.quantile(0.5) else {
      throw PipelineError.noSurface(reason: "the point cloud is empty.")
    }
    return TileBase(
      samples: samples, solution: solution,
      grid: TileGrid(counts, maximumPoints: options.maximumPoints), footprint: footprint,
      voxelSize: Double(footprint) * meshing.options.downsampling.voxelFootprints)
  }

  /// The surface of a tile and of its halo, before seams are adjusted, and its samples; nil if
  /// there are too few.
  func solve(
    _ points: PointCloud, of base: TileBase, _ context: StageContext
  ) throws -> (solution: PoissonSolution, samples: PointCloud)? {
    let kept = try points.filtered(
      by: isOfScene(points, base, context.control.part(from: 0, to: 0.1)))
    let downsampling = VoxelDownsampling(options: meshing.options.downsampling)
    let averaged = try downsampling.run(
      kept, footprint: base.footprint, context.part(from: 0.1, to: 0.2))
    let samples = try downsampling.withoutOutliers(
      averaged, coarsest: base.samples.cloud.footprints.quantile(0.99),
      context.control.part(from: 0.2, to: 0.3))
    guard samples.count >= meshing.options.poisson.minimumPoints else { return nil }
    let solution = try base.solution.refined(
      positions: samples.positions, normals: samples.normals, depth: depth(base),
      context.control.part(from: 0.3, to: 1))
    return (solution, samples)
  }

  /// Whether points are near samples of the scene, and inside the masks.
  private func isOfScene(
    _ points: PointCloud, _ base: TileBase, _ control: KernelControl
  ) throws -> [Bool] {
    let nearest = try NearestPoints(
      of: points.positions, in: base.samples.cloud.positions, control)
    let isInside = try silhouettes?.areInside(points.positions, control)
    return points.positions.indices.map { index in
      let sample = nearest.indices[index]
      guard sample >= 0, isInside?[index] != false else { return false }
      let spacing = max(
        Float(base.samples.voxelSize), base.samples.cloud.footprints[Int(sample)])
      return nearest.distances[index] <= Float(options.sampleReach) * spacing
    }
  }

  private func depth(_ base: TileBase) -> Int {
    base.depth(PoissonSurface(options: meshing.options.poisson))
  }

  /// Cells of the lattice by which the surface of a tile is made beyond its box.
  func halo(_ base: TileBase) -> Int {
    let finer = depth(base) - lattice(base)
    return max(1, (options.haloCells + (1 << finer) - 1) >> finer)
  }

  /// Cells of the lattice by which the points of a tile reach beyond its box.
  func reach(_ base: TileBase) -> Int {
    let finer = max(0, base.solution.depth + 1 - lattice(base))
    return halo(base) + max(1, (options.solverCells + (1 << finer) - 1) >> finer)
  }

  private func lattice(_ base: TileBase) -> Int { base.grid.boxes.first?.depth ?? 0 }

  /// The final surface in the box of a tile, with normals and colors, from its solution with the
  /// values of its neighbors; nil if there is none.
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
      solved, samples: samples, scene: scene, spacing: spacing(base),
      support: base.samples.support, silhouettes: silhouettes, part: part, reconstruction,
      context.part(from: 0.2, to: 0.8))
    guard !trimmed.triangles.isEmpty else { return nil }
    var mesh = try MeshCleaning(options: meshing.options.cleaning).run(
      trimmed, samples: samples, part: part, context.part(from: 0.8, to: 1))
    mesh.triangles = mesh.triangles.filter { isOwned($0, of: mesh, box, base.grid.cube) }
    return mesh.triangles.isEmpty ? nil : mesh.withoutUnusedVertices()
  }

  /// Whether the center of a triangle is in a box.
  private func isOwned(_ triangle: Triangle, of mesh: Mesh, _ box: CellBox, _ cube: Cube) -> Bool {
    let (a, b, c) = mesh.corners(of: triangle)
    // In double precision the sum is exact, in whatever order.
    let sum = SIMD3<Double>(a) + SIMD3<Double>(b) + SIMD3<Double>(c)
    let cell = ((sum / 3 - cube.origin) / cube.side * exp2(Double(box.depth))).rounded(.down)
    let last = Double((1 << box.depth) - 1)
    return (0..<3).allSatisfy { axis in
      let index = min(max(cell[axis], 0), last)
      return index >= Double(box.low[axis]) && index < Double(box.high[axis])
    }
  }

  /// Spacing of the samples, or half a cell where cells are larger.
  private func spacing(_ base: TileBase) -> Double {
    max(base.voxelSize, base.grid.cube.side / exp2(Double(depth(base))) / 2)
  }

  private func part(around box: CellBox, _ base: TileBase) -> SurfacePart {
    let halo = halo(base)
    let cell = base.grid.cube.side / exp2(Double(box.depth))
    let largest =
      base.grid.boxes.map { box in
        let size = box.dilated(by: halo).high &- box.dilated(by: halo).low
        return Double(size.max()) * cell
      }.max() ?? cell
    let coarsest = max(
      options.freeSpaceSpacings * spacing(base), 1.1 * largest / Double(FreeSpace.maximumCells))
    let local = options.localShare * Double(halo) * cell
    let dilated = box.dilated(by: halo)
    return SurfacePart(
      low: base.grid.cube.origin + SIMD3<Double>(dilated.low) * cell,
      high: base.grid.cube.origin + SIMD3<Double>(dilated.high) * cell,
      rim: 2 * spacing(base), minimumComponentArea: local * local,
      extent: Float(local / meshing.options.trimming.holeFilling.smallShare),
      freeSpaceCell: cell / max(1, (cell / coarsest).rounded(.down)))
  }
}

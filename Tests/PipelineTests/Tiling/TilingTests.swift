import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Uneven ground with a gap, in tiles.
@Suite(.endToEnd) struct TilingTests {
  private static let footprint: Float = 0.016
  private static let gap: (center: SIMD2<Float>, radius: Float) = ([0.1, -0.05], 0.2)

  /// The points of four views.
  private let views: [PointCloud]
  private let cloud: PointCloud
  private let reconstruction: Reconstruction

  init() {
    var random = SeededGenerator(seed: 4)
    views = (0..<4).map { view in
      var cloud = PointCloud()
      while cloud.count < 4000 {
        let (x, y) = (Float(random.uniform()) * 2 - 1, Float(random.uniform()) * 2 - 1)
        guard (SIMD2(x, y) - Self.gap.center).length > Self.gap.radius else { continue }
        let (slopeX, slopeY) = (
          0.3 * cos(6 * x) * cos(6 * y), -0.3 * sin(6 * x) * sin(6 * y)
        )
        cloud.positions.append([x, 0.05 * sin(6 * x) * cos(6 * y), y])
        cloud.normals.append(SIMD3<Float>(-slopeX, 1, -slopeY).normalized)
        cloud.colors.append([100, 150, 200])
        cloud.consistency.append(0.9)
        cloud.footprints.append(Self.footprint)
        cloud.photoIndices += [UInt16(2 * view + 1), UInt16(2 * view + 3)]
        cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
      }
      return cloud
    }
    cloud = views.reduce(into: PointCloud()) { $0.append($1) }
    reconstruction = IsolationScene().reconstruction(target: .zero)
  }

  private func tiling(maximumPoints: Int = 5000, baseDepth: Int) -> Tiling {
    var meshing = MeshGeneration()
    meshing.options.isolatesObject = false
    meshing.options.maximumDepth = baseDepth
    // Boundaries that depend on little more than their edges, and a halo that is as small.
    meshing.options.trimming.boundary.steps = 8
    meshing.options.trimming.boundary.reach = 3
    var options = Tiling.Options()
    options.maximumPoints = maximumPoints
    return Tiling(
      options: options, meshing: meshing, reconstruction: reconstruction, silhouettes: nil)
  }

  private func tiles(
    maximumPoints: Int, baseDepth: Int = 5, threads: Int = 2
  ) throws -> (base: TileBase, meshes: [Mesh]) {
    let tiling = tiling(maximumPoints: maximumPoints, baseDepth: baseDepth)
    let context = StageContext(control: KernelControl(threadCount: threads))
    let source = FusedViews(count: 4) { [views] in views[$0] }
    let system = try self.system(of: tiling, context)
    let base = try tiling.base(system, source, context)
    let folder = try TemporaryFolder()
    let surfaces = TileSurfaces(
      tiling: tiling, base: base, views: source,
      store: TileStore(folder: folder.url, isShared: false, inputs: 1)
    ) { system.samples }
    return (base, try meshes(of: surfaces, context))
  }

  private func system(of tiling: Tiling, _ context: StageContext) throws -> SurfaceSystem {
    try tiling.meshing.system(
      of: cloud, tiling.reconstruction, silhouettes: nil, support: nil, context)
  }

  private func meshes(of surfaces: TileSurfaces, _ context: StageContext) throws -> [Mesh] {
    for tile in 0..<surfaces.count { try surfaces.solve(tile, context) }
    return try (0..<surfaces.count).compactMap {
      try surfaces.surface($0, observed: cloud, context)?.mesh
    }
  }

  /// The edges with one triangle only, as the positions of their ends, if vertices at exactly the
  /// same position are one.
  private func openEdges(_ meshes: [Mesh]) -> [(SIMD3<Float>, SIMD3<Float>)] {
    var uses: [[SIMD3<Float>]: Int] = [:]
    for mesh in meshes {
      for t in mesh.triangles {
        let (a, b, c) = mesh.corners(of: t)
        for (start, end) in [(a, b), (b, c), (c, a)] {
          uses[[start, end], default: 0] += 1
          uses[[end, start], default: 0] -= 1
        }
      }
    }
    return uses.filter { $0.value > 0 }.map { ($0.key[0], $0.key[1]) }
  }

  /// Only where samples end is the surface open: up to 2.5 spacings beyond them, and a cell, whose
  /// side is at most two spacings.
  @Test func tilesFitTogether() throws {
    let rim = (2.5 + 2) * Self.footprint
    let (base, meshes) = try tiles(maximumPoints: 2200)
    #expect(base.grid.boxes.count >= 8 && meshes.count == base.grid.boxes.count)
    for (start, _) in openEdges(meshes) {
      let distance = (SIMD2(start.x, start.z) - Self.gap.center).length
      #expect(
        max(abs(start.x), abs(start.z)) > 1 - rim || abs(distance - Self.gap.radius) < rim,
        "\(start) is open.")
    }
  }

  @Test func tilesAreWhatOneTileIs() throws {
    let (_, meshes) = try tiles(maximumPoints: 2200)
    let (_, one) = try tiles(maximumPoints: 1_000_000)
    let count = { (meshes: [Mesh]) in meshes.reduce(0) { $0 + $1.triangles.count } }
    #expect(one.count == 1)
    #expect(abs(count(meshes) - count(one)) < count(one) / 50)
    let errors = meshes.flatMap(\.positions).map {
      abs($0.y - 0.05 * sin(6 * $0.x) * cos(6 * $0.z))
    }
    #expect((errors.max() ?? 1) < 0.01)
  }

  @Test func threadsDoNotMatter() throws {
    let runs = try [1, 3].map { try tiles(maximumPoints: 5000, threads: $0).meshes }
    for (one, other) in zip(runs[0], runs[1]) {
      #expect(one.positions == other.positions && one.triangles == other.triangles)
    }
  }

  /// All views have points in all tiles.
  @Test func viewsAreWork() throws {
    let (base, _) = try tiles(maximumPoints: 5000)
    let perView = Double(cloud.count) / 4 / 5
    #expect(base.works.count == base.grid.boxes.count)
    for (work, points) in zip(base.works, base.grid.pointCounts) {
      #expect(work == points + Int(perView * 4))
    }
    let blocks = (0..<3).flatMap { base.tiles(of: Block(index: $0, of: 3)) }
    #expect(blocks.sorted() == Array(base.grid.boxes.indices))
  }

  /// Another process has the base from a file, the samples near each tile, and solutions of tiles
  /// that still others made. What is damaged is made again.
  @Test func storedResultsGiveTheSameTiles() throws {
    let (base, meshes) = try tiles(maximumPoints: 5000)
    let folder = try TemporaryFolder()
    let store = TileStore(folder: folder.url, isShared: true, inputs: 1)
    let (context, tiling) = (StageContext(control: KernelControl()), tiling(baseDepth: 5))
    let samples = try system(of: tiling, context).samples
    try store.save(base, observed: cloud)
    #expect(store.surroundings == nil)
    let gains = [ExposureGain.none, ExposureGain(factors: [0.9, 1, 1.1])]
    try store.save(OccluderRecord(meshes[0], gains: gains))
    let stored = try #require(store.base)
    #expect(stored.grid == base.grid && stored.viewBoxes == base.viewBoxes)
    #expect(stored.coarsestFootprint == base.coarsestFootprint)
    let surroundings = try #require(store.surroundings)
    #expect(surroundings.observed.positions == cloud.positions)
    #expect(surroundings.occluders.positions == meshes[0].positions)
    #expect(surroundings.occluders.triangles == meshes[0].triangles)
    #expect(surroundings.gains == gains)

    /// The uses of samples of the scene, and of views, until all tiles are there.
    func uses() throws -> (samples: Int, views: Int) {
      var uses = (samples: 0, views: 0)
      let views = FusedViews(count: 4) { [views] in
        uses.views += 1
        return views[$0]
      }
      let surfaces = TileSurfaces(tiling: tiling, base: stored, views: views, store: store) {
        uses.samples += 1
        return samples
      }
      let same = try self.meshes(of: surfaces, context)
      #expect(same.map(\.positions) == meshes.map(\.positions))
      #expect(same.map(\.triangles) == meshes.map(\.triangles))
      return uses
    }
    func damage(_ kind: String) throws {
      let names = try FileManager.default.contentsOfDirectory(atPath: folder.url.path)
      let name = try #require(names.sorted().first { $0.hasPrefix(kind) })
      try Data([0]).write(to: folder.url.appendingPathComponent(name))
    }
    try TileSurfaces(
      tiling: tiling, base: stored, views: FusedViews(count: 0) { [views] in views[$0] },
      store: store
    ) { samples }.storeSamples(of: samples, context.control)
    let first = try uses()
    #expect(first.samples == 0 && first.views > 0)
    let second = try uses()
    #expect(second.samples == 0 && second.views == 0)
    try damage("solvedTile")
    #expect(try uses().samples == 0)
    try damage("solvedTile")
    try damage("tileSamples")
    _ = try uses()
    #expect(TileStore(folder: folder.url, isShared: true, inputs: 2).base == nil)
  }
}

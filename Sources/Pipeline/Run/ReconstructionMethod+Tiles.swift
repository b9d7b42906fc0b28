import Foundation
import Kernels
import SceneModel

extension ReconstructionMethod {
  /// What the tiles of a scene are made from.
  struct TileInput {
    let scene: ObjectScene
    let geometry: ModelGeometry
    let output: TileOutput
    fileprivate let store: TileStore
    fileprivate let base: Base

    /// What tiles need of the whole scene.
    fileprivate enum Base {
      /// What other processes or runs have stored; surroundings, if they are needed.
      case stored(TileBase, TileSurroundings?)
      /// To be made from the cloud and the surface of the scene, and what that was made from, if it
      /// is known.
      case made(from: PointCloud, Mesh, SurfaceSystem?)
    }
  }

  /// Finds what a step of the tiles, or all of them, are made from, or makes it. Models contain the
  /// part of the surface inside the crop box, moved by the transform.
  func tileInput(
    _ scene: ObjectScene, in geometry: ModelGeometry, to output: TileOutput,
    for step: TilePart? = nil
  ) throws -> TileInput {
    let store = try cache.tileStore(of: scene.photos, configuration)
    let base =
      store.stored(for: step)
      ?? .made(
        from: try densify(scene), try surface(scene), cache.system(viewPixels: viewPixels))
    return TileInput(scene: scene, geometry: geometry, output: output, store: store, base: base)
  }

  /// Makes the surface of the scene in tiles of full detail, textures each and writes it.
  func writeTiles(_ input: TileInput, _ context: StageContext) throws {
    // What is noted of a tile concerns no other.
    let own = StageContext(control: context.control)
    let models = try tileModels(input, own.part(from: 0, to: 0.1))
    let written = try models.prepare()
    let count = written.count
    for tile in 0..<count where written[tile] == nil {
      try models.surfaces.solve(tile, own.part(from: 0.1, to: 0.3).part(tile, of: count))
    }
    var index = TileIndex(isMetric: input.scene.reconstruction.worldFrame.scale.isMetric)
    index.tiles = try (0..<count).compactMap { tile in
      try written[tile].map(\.tile)
        ?? models.write(tile, own.part(from: 0.3, to: 1).part(tile, of: count))
    }
    try input.output.write(index)
    context.notes.record("tiles", Double(index.tiles.count))
  }

  /// Makes what all tiles need, and stores it.
  func prepareTiles(_ input: TileInput, _ context: StageContext) throws {
    try tileModels(input, StageContext(control: context.control)).prepare()
  }

  /// Makes a step of a block of the tiles.
  func make(
    _ part: TilePart, _ block: Block, of input: TileInput, _ context: StageContext
  ) throws {
    let own = StageContext(control: context.control)
    let begin = own.part(from: 0, to: 0.05)
    let steps = { (tiles: Range<Int>, tile: Int) in
      own.part(from: 0.05, to: 1).part(tile - tiles.lowerBound, of: tiles.count)
    }
    switch part {
    case .tileSurfaces:
      let (surfaces, _) = try tileSurfaces(input, begin)
      let tiles = surfaces.base.tiles(of: block)
      for tile in tiles { try surfaces.solve(tile, steps(tiles, tile)) }
    case .tiles:
      let models = try tileModels(input, begin)
      let tiles = models.surfaces.base.tiles(of: block)
      for tile in tiles { try models.write(tile, steps(tiles, tile)) }
    }
  }

  private func tileModels(_ input: TileInput, _ context: StageContext) throws -> TileModels {
    let (surfaces, surroundings) = try tileSurfaces(input, context)
    guard let surroundings else {
      throw KernelError.invalidArgument("models of tiles need what lies around them")
    }
    return try TileModels(
      surfaces, surroundings, input.scene, in: input.geometry, to: input.output, configuration)
  }

  private func tileSurfaces(
    _ input: TileInput, _ context: StageContext
  ) throws -> (TileSurfaces, TileSurroundings?) {
    let (scene, control) = (input.scene, context.part(from: 0, to: 0).control)
    let tiling = Tiling(
      options: configuration.tiling, meshing: MeshGeneration(configuration.meshGeneration),
      reconstruction: scene.reconstruction,
      silhouettes: try Silhouettes(scene.reconstruction, images: scene.photos.images, control))
    let views = try PointCloudGeneration(options: configuration.pointCloudGeneration)
      .fusedViews(
        scene.reconstruction, images: scene.photos.images, folder: try cache.viewFolder(), control)
    func system(of cloud: PointCloud) throws -> SurfaceSystem {
      try tiling.meshing.system(
        of: cloud, scene.reconstruction, silhouettes: tiling.silhouettes, support: scene.support,
        context.part(from: 0, to: 0.8))
    }
    switch input.base {
    case .stored(let base, let surroundings):
      let surfaces = TileSurfaces(tiling: tiling, base: base, views: views, store: input.store) {
        // Only for tiles whose file is damaged.
        try system(of: try densify(scene)).samples
      }
      return (surfaces, surroundings)
    case .made(let cloud, let surface, let known):
      let system = try known ?? system(of: cloud)
      let base = try tiling.base(system, views, context.part(from: 0.8, to: 1))
      let surfaces = TileSurfaces(tiling: tiling, base: base, views: views, store: input.store) {
        system.samples
      }
      if input.store.isShared { try surfaces.storeSamples(of: system.samples, control) }
      let surroundings = try surroundings(of: surface, cloud, scene)
      try input.store.save(base, surroundings)
      return (surfaces, surroundings)
    }
  }

  /// What lies around tiles.
  private func surroundings(
    of surface: Mesh, _ cloud: PointCloud, _ scene: ObjectScene
  ) throws -> TileSurroundings {
    var observed = cloud
    // Appending copies the cloud.
    if scene.surroundings.count > 0 { observed.append(scene.surroundings) }
    return TileSurroundings(
      observed: observed,
      occluders: try surface.simplified(
        maximumTriangles: configuration.textureMapping.occluderTriangles, KernelControl()))
  }
}

extension TileStore {
  /// What is stored of the whole scene for a step of the tiles, or for all; nil if a part of it is
  /// missing.
  fileprivate func stored(for step: TilePart?) -> ReconstructionMethod.TileInput.Base? {
    guard let base else { return nil }
    if step == .tileSurfaces { return .stored(base, nil) }
    return surroundings.map { .stored(base, $0) }
  }
}

extension StageContext {
  /// The context of one of several steps of equal length.
  fileprivate func part(_ index: Int, of count: Int) -> StageContext {
    part(from: Double(index) / Double(count), to: Double(index + 1) / Double(count))
  }
}

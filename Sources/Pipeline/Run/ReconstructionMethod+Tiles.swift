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
    /// What all tiles need: stored, or to be made from the cloud and the surface of the scene, and
    /// what the surface was made from, if that is known.
    fileprivate let base: Base

    fileprivate enum Base {
      case stored(TileBase, TileSurroundings)
      case made(from: PointCloud, Mesh, SurfaceSystem?)
    }
  }

  /// Finds what the tiles of a scene are made from, or makes it. Its models contain the part of the
  /// surface inside the crop box, moved by the transform.
  func tileInput(
    _ scene: ObjectScene, in geometry: ModelGeometry, to output: TileOutput
  ) throws -> TileInput {
    let store = try cache.tileStore(of: scene.photos, configuration)
    let base: TileInput.Base =
      if let base = store.base, let surroundings = store.surroundings {
        .stored(base, surroundings)
      } else {
        .made(
          from: try densify(scene), try surface(scene), cache.system(viewPixels: viewPixels))
      }
    return TileInput(scene: scene, geometry: geometry, output: output, store: store, base: base)
  }

  /// Makes the surface of the scene in tiles of full detail, textures each and writes it.
  func writeTiles(_ input: TileInput, _ context: StageContext) throws {
    // What is noted of a tile concerns no other.
    let own = StageContext(control: context.control)
    let models = try tileModels(input, own.part(from: 0, to: 0.1))
    try models.prepare()
    let count = models.surfaces.count
    for tile in 0..<count {
      try models.surfaces.solve(tile, own.part(from: 0.1, to: 0.3).part(tile, of: count))
    }
    var index = TileIndex(isMetric: input.scene.reconstruction.worldFrame.scale.isMetric)
    index.tiles = try (0..<count).compactMap {
      try models.write($0, own.part(from: 0.3, to: 1).part($0, of: count))
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
    let models = try tileModels(input, own.part(from: 0, to: 0.05))
    let tiles = block.range(of: models.surfaces.count)
    for tile in tiles {
      let step = own.part(from: 0.05, to: 1).part(tile - tiles.lowerBound, of: tiles.count)
      switch part {
      case .tileSurfaces: try models.surfaces.solve(tile, step)
      case .tiles: try models.write(tile, step)
      }
    }
  }

  private func tileModels(_ input: TileInput, _ context: StageContext) throws -> TileModels {
    let (scene, control) = (input.scene, context.part(from: 0, to: 0).control)
    let tiling = Tiling(
      options: configuration.tiling, meshing: MeshGeneration(configuration.meshGeneration),
      reconstruction: scene.reconstruction,
      silhouettes: try Silhouettes(scene.reconstruction, images: scene.photos.images, control))
    let views = try PointCloudGeneration(options: configuration.pointCloudGeneration)
      .fusedViews(
        scene.reconstruction, images: scene.photos.images, folder: try cache.viewFolder(), control)
    let (base, surroundings) = try base(input, tiling, views, context)
    return try TileModels(
      TileSurfaces(tiling: tiling, base: base, views: views, store: input.store), surroundings,
      scene, in: input.geometry, to: input.output, configuration)
  }

  private func base(
    _ input: TileInput, _ tiling: Tiling, _ views: FusedViews, _ context: StageContext
  ) throws -> (TileBase, TileSurroundings) {
    switch input.base {
    case .stored(let base, let surroundings): return (base, surroundings)
    case .made(let cloud, let surface, let system):
      let base = try tiling.base(cloud, system, support: input.scene.support, views, context)
      var observed = cloud
      // Appending copies the cloud.
      if input.scene.surroundings.count > 0 { observed.append(input.scene.surroundings) }
      let surroundings = TileSurroundings(
        observed: observed,
        occluders: try surface.simplified(
          maximumTriangles: configuration.textureMapping.occluderTriangles, KernelControl()))
      try input.store.save(base, surroundings)
      return (base, surroundings)
    }
  }
}

extension StageContext {
  /// The context of one of several steps of equal length.
  fileprivate func part(_ index: Int, of count: Int) -> StageContext {
    part(from: Double(index) / Double(count), to: Double(index + 1) / Double(count))
  }
}

import Foundation
import Kernels
import SceneModel

extension ReconstructionMethod {
  /// What the tiles of a scene are made from.
  struct TileInput {
    /// Without sparse points and surroundings, if its base is stored.
    let scene: ObjectScene
    fileprivate let views: DenseViews
    let geometry: ModelGeometry
    let output: TileOutput
    fileprivate let store: TileStore
    fileprivate let base: Base

    /// What tiles need of the whole scene.
    fileprivate enum Base {
      /// What other processes or runs have stored; surroundings, if they are needed.
      case stored(TileBase, TileSurroundings?)
      /// To be made from the cloud of the scene, its surface if that is needed, and what the
      /// surface is made from, if it is known.
      case made(from: PointCloud, Mesh?, SurfaceSystem?)
    }
  }

  /// Finds what all tiles are made from, or makes it. Models contain the part of the surface inside
  /// the crop box, moved by the transform.
  func tileInput(
    _ scene: ObjectScene, in geometry: ModelGeometry, to output: TileOutput
  ) throws -> TileInput {
    let store = try cache.tileStore(of: scene.photos, configuration)
    let views = try denseViews(of: scene)
    func input(_ base: TileInput.Base) -> TileInput {
      TileInput(
        scene: scene, views: views, geometry: geometry, output: output, store: store, base: base)
    }
    // Not `??`: the compiler (Swift 6.3) leaves the stack misaligned if what follows it throws.
    if let stored = store.stored(for: nil) { return input(stored) }
    let (cloud, surface) = (try densify(scene), try surface(scene))
    return input(.made(from: cloud, surface, cache.system(viewPixels: viewPixels)))
  }

  /// What a step of the tiles is made from, if earlier parts of the run have stored all of it.
  func storedTileInput(
    _ photos: PhotoSet, in geometry: ModelGeometry, to output: TileOutput, for step: TilePart
  ) throws -> TileInput? {
    guard let (scene, views) = try cache.sceneStore(of: photos, configuration)?.scene(of: photos)
    else { return nil }
    let store = try cache.tileStore(of: scene.photos, configuration)
    return store.stored(for: step).map {
      TileInput(
        scene: scene, views: views, geometry: geometry, output: output, store: store, base: $0)
    }
  }

  /// Makes the surface of the scene in tiles of full detail, textures each and writes it.
  func writeTiles(_ input: TileInput, _ context: StageContext) throws {
    // What is noted of a tile concerns no other.
    let own = StageContext(control: context.control)
    let models = try tileModels(input, own.part(from: 0, to: 0.1))
    let written = try models.prepare(own.control.withoutProgress)
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

  /// Makes what tiles and the surface of the scene are made from, and stores it.
  func makeTileBase(
    of scene: ObjectScene, _ views: DenseViews, in geometry: ModelGeometry, for output: TileOutput
  ) throws {
    let store = try cache.tileStore(of: scene.photos, configuration)
    let cloud = try densify(scene, views)
    let images = scene.photos.images
    let system = try recorder.run(.meshGeneration, images: images) { context in
      try MeshGeneration(configuration.meshGeneration).system(
        of: cloud, scene.reconstruction,
        silhouettes: try Silhouettes(scene.reconstruction, images: images), support: scene.support,
        context)
    }
    let notes = { SavedNotes(recorder.notes[$0] ?? StageNotes()) }
    let record = SampleRecord(
      samples: system.samples, denseNotes: notes(.pointCloudGeneration),
      notes: notes(.meshGeneration))
    let scenes = try cache.sceneStore(of: scene.photos, configuration)
    let input = TileInput(
      scene: scene, views: views, geometry: geometry, output: output, store: store,
      base: .made(from: cloud, nil, system))
    try recorder.run(.optimization, images: images) { context in
      try beside({ try scenes?.save(record) }, context.control) {
        _ = try tileModels(input, StageContext(control: context.control))
          .prepare(context.control.withoutProgress)
      }
    }
  }

  /// Makes the surface of the scene, and stores what hides tiles and the photos' gains.
  func makeSurface(of scene: ObjectScene) throws {
    let store = try cache.tileStore(of: scene.photos, configuration)
    let surface = try surface(scene)
    try recorder.run(.optimization, images: scene.photos.images) { context in
      try store.save(
        try occluders(surface, of: scene, StageContext(control: context.control)))
    }
  }

  /// The surface of the samples that another process stored; nil if none did.
  func meshOfStoredSamples(_ scene: ObjectScene) throws -> Mesh? {
    guard configuration.tiles != nil else { return nil }
    let store = try cache.tileStore(of: scene.photos, configuration)
    let scenes = try cache.sceneStore(of: scene.photos, configuration)
    guard let record = scenes?.samples, let base = store.base, let observed = store.observed else {
      return nil
    }
    try recorder.run(.pointCloudGeneration) { record.denseNotes.replay(to: $0.notes) }
    return try mesh(scene) { meshing, silhouettes, context in
      record.notes.replay(to: context.notes)
      return try meshing.mesh(
        of: SurfaceSystem(samples: record.samples, solution: base.solution), observed: observed,
        scene.reconstruction, silhouettes: silhouettes, context)
    }
  }

  /// Makes a step of a block of the tiles.
  func make(
    _ part: TilePart, _ block: Block, of input: TileInput, _ context: StageContext
  ) throws {
    let own = StageContext(control: context.control)
    let begin = own.part(from: 0, to: 0.05)
    func each(_ tiles: [Int], _ body: (Int, StageContext) throws -> Void) throws {
      for (number, tile) in tiles.enumerated() {
        try body(tile, own.part(from: 0.05, to: 1).part(number, of: tiles.count))
      }
    }
    switch part {
    case .tileSurfaces:
      let (surfaces, _) = try tileSurfaces(input, begin)
      try each(surfaces.base.tiles(of: block)) { try surfaces.solve($0, $1) }
    case .tiles:
      let models = try tileModels(input, begin)
      try each(models.surfaces.base.tiles(of: block)) { try models.write($0, $1) }
    }
  }

  private func tileModels(_ input: TileInput, _ context: StageContext) throws -> TileModels {
    let (surfaces, surroundings) = try tileSurfaces(input, context)
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
      silhouettes: try Silhouettes(scene.reconstruction, images: scene.photos.images))
    // What is missing or damaged is made again from the whole scene.
    let wholeScene = { try self.scene(try ingest()) }
    let views = try PointCloudGeneration(options: configuration.pointCloudGeneration)
      .fusedViews(
        of: input.views, scene.reconstruction, images: scene.photos.images,
        folder: try cache.viewFolder(), control
      ) { try denseViews(of: try wholeScene()) }
    func system(of cloud: PointCloud, _ scene: ObjectScene) throws -> SurfaceSystem {
      try tiling.meshing.system(
        of: cloud, scene.reconstruction, silhouettes: tiling.silhouettes, support: scene.support,
        context.part(from: 0, to: 0.8))
    }
    switch input.base {
    case .stored(let base, let surroundings):
      let surfaces = TileSurfaces(tiling: tiling, base: base, views: views, store: input.store) {
        let scene = try wholeScene()
        return try system(of: try densify(scene), scene).samples
      }
      return (surfaces, surroundings)
    case .made(let cloud, let surface, let known):
      let system = try known ?? system(of: cloud, scene)
      let base = try tiling.base(system, views, context.part(from: 0.8, to: 0.85))
      let surfaces = TileSurfaces(tiling: tiling, base: base, views: views, store: input.store) {
        system.samples
      }
      if input.store.isShared { try surfaces.storeSamples(of: system.samples, control) }
      let observed = tiling.meshing.observed(cloud, scene.surroundings)
      try input.store.save(base, observed: observed)
      guard let surface else { return (surfaces, nil) }
      let occluders = try occluders(surface, of: scene, context.part(from: 0.85, to: 1))
      try input.store.save(occluders)
      return (surfaces, TileSurroundings(observed: observed, occluders))
    }
  }

  /// What hides tiles from photos, and the photos' gains on it.
  private func occluders(
    _ surface: Mesh, of scene: ObjectScene, _ context: StageContext
  ) throws -> OccluderRecord {
    let options = configuration.textureMapping
    let mesh = try surface.simplified(
      maximumTriangles: options.occluderTriangles, context.part(from: 0, to: 0.3).control)
    let gains = try TextureMapping(options: options).gains(
      on: mesh, scene.reconstruction, images: scene.photos.images, context.part(from: 0.3, to: 1))
    return OccluderRecord(mesh, gains: gains)
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

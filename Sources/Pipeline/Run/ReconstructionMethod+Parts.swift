import Kernels
import SceneModel

extension ReconstructionMethod {
  /// Makes a part of the work from the parts before it. Tiles contain the part of the surface that
  /// `geometry` selects.
  func make(_ part: RunPart, in geometry: ModelGeometry) throws {
    if case .inspections(let block) = part { return try inspect(block) }
    let photos = try ingest()
    switch part {
    case .inspections, .photos: break
    case .features(let block):
      try alignmentPart(photos) { try $0.makeFeatures(of: block, $1) }
    case .candidates: try alignmentPart(photos) { try $0.findCandidates($1) }
    case .pairs(let block): try alignmentPart(photos) { try $0.test(block, $1) }
    case .matches(let block): try alignmentPart(photos) { try $0.match(block, $1) }
    case .morePairs: try alignmentPart(photos) { try $0.selectMorePairs($1) }
    case .moreMatches(let block): try alignmentPart(photos) { try $0.matchMore(block, $1) }
    case .cameras:
      let scene = try scene(photos)
      try cache.sceneStore(of: photos, configuration)?.save(scene, try denseViews(of: scene))
    case .views(let part, let block): try make(part, block, of: photos)
    case .tileBase:
      let scene = try scene(photos)
      try makeTileBase(
        of: scene, try storedViews(of: scene, photos), in: geometry, for: try tileOutput)
    case .surface: try makeSurface(of: try scene(photos))
    case .tiles(let part, let block):
      try tilePart(photos, in: geometry, for: part) { try make(part, block, of: $0, $1) }
    case .tileIndex:
      try tilePart(photos, in: geometry, for: .tiles) { try writeTiles($0, $1) }
    }
  }

  /// The scene with all that is known of it.
  func scene(_ photos: PhotoSet) throws -> ObjectScene {
    try maskObject(photos, try align(photos))
  }

  /// The views of a scene's dense stage.
  func denseViews(of scene: ObjectScene) throws -> DenseViews {
    try recorder.recordingErrors {
      try DenseViews(
        scene.reconstruction, images: scene.photos.images,
        options: configuration.pointCloudGeneration, recorder.control)
    }
  }

  /// The views of a scene's dense stage that an earlier part stored, or else selected now.
  private func storedViews(of scene: ObjectScene, _ photos: PhotoSet) throws -> DenseViews {
    let stored = try cache.sceneStore(of: photos, configuration)?.scene(of: photos)
    // Not `??`, as in `tileInput`.
    if let stored { return stored.views }
    return try denseViews(of: scene)
  }

  private func inspect(_ block: Block) throws {
    guard let units = cache.units else { throw Self.noDirectory }
    try recorder.recordingErrors { try cache.lockDirectory() }
    try recorder.run(.preProcessing) {
      try source.inspect(block, configuration, units, $0)
    }
  }

  private func alignmentPart(
    _ photos: PhotoSet, _ body: (AlignmentParts, StageContext) throws -> Void
  ) throws {
    guard let units = cache.units else { throw Self.noDirectory }
    try recorder.run(.imageAlignment, images: photos.images) { context in
      let parts = AlignmentParts(
        alignment: ImageAlignment(configuration.alignmentOptions(for: photos.images)),
        store: units, photos: photos.ingested.photos, cameras: photos.ingested.cameras,
        images: photos.images)
      try body(parts, context)
    }
  }

  /// Only the first step needs sparse points, and later ones if what they read is damaged.
  private func make(_ part: DensePart, _ block: Block, of photos: PhotoSet) throws {
    let stored = try cache.sceneStore(of: photos, configuration)?
      .scene(of: photos, withPointsOf: part == .coarse ? block : nil)
    if let stored, try make(part, block, of: stored.views, in: stored.scene) { return }
    let scene = try scene(photos)
    _ = try make(part, block, of: try denseViews(of: scene), in: scene)
  }

  private func make(
    _ part: DensePart, _ block: Block, of views: DenseViews, in scene: ObjectScene
  ) throws -> Bool {
    guard let folder = cache.checkpoint?.views else { throw Self.noDirectory }
    let images = scene.photos.images
    return try recorder.run(.pointCloudGeneration, images: images) { context in
      try PointCloudGeneration(options: configuration.pointCloudGeneration)
        .make(
          part.step, block, of: views, scene.reconstruction, images: images, folder: folder,
          context)
    }
  }

  private func tilePart(
    _ photos: PhotoSet, in geometry: ModelGeometry, for step: TilePart,
    _ body: (TileInput, StageContext) throws -> Void
  ) throws {
    let output = try tileOutput
    let input: TileInput
    // Not `??`, as in `tileInput`.
    if let stored = try storedTileInput(photos, in: geometry, to: output, for: step) {
      input = stored
    } else {
      input = try tileInput(try scene(photos), in: geometry, to: output)
    }
    try recorder.run(.optimization, images: input.scene.photos.images) { try body(input, $0) }
  }

  private var tileOutput: TileOutput {
    get throws {
      if let output = configuration.tiles { return output }
      throw KernelError.invalidArgument("a part of the tiles needs a folder for them")
    }
  }

  private static var noDirectory: KernelError {
    .invalidArgument("a part of a run needs a checkpoint directory")
  }
}

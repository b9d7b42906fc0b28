import Kernels
import SceneModel

extension ReconstructionMethod {
  /// Makes a part of the work from the parts before it. Tiles contain the part of the surface that
  /// `geometry` selects.
  func make(_ part: RunPart, in geometry: ModelGeometry) throws {
    let photos = try ingest()
    switch part {
    case .photos: break
    case .features(let block):
      try alignmentPart(photos) { try $0.makeFeatures(of: block, $1) }
    case .pairs: try alignmentPart(photos) { try $0.selectPairs($1) }
    case .matches(let block): try alignmentPart(photos) { try $0.match(block, $1) }
    case .morePairs: try alignmentPart(photos) { try $0.selectMorePairs($1) }
    case .moreMatches(let block): try alignmentPart(photos) { try $0.matchMore(block, $1) }
    case .cameras: _ = try scene(photos)
    case .views(let part, let block): try make(part, block, of: try scene(photos))
    case .surface:
      try tilePart(try scene(photos), in: geometry) { try prepareTiles($0, $1) }
    case .tiles(let part, let block):
      try tilePart(try scene(photos), in: geometry, for: part) {
        try make(part, block, of: $0, $1)
      }
    }
  }

  private func scene(_ photos: PhotoSet) throws -> ObjectScene {
    try maskObject(photos, try align(photos))
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

  private func make(_ part: DensePart, _ block: Block, of scene: ObjectScene) throws {
    guard let folder = cache.checkpoint?.views else { throw Self.noDirectory }
    try recorder.run(.pointCloudGeneration, images: scene.photos.images) { context in
      try PointCloudGeneration(options: configuration.pointCloudGeneration)
        .make(
          part.step, block, of: scene.reconstruction, images: scene.photos.images, folder: folder,
          context)
    }
  }

  private func tilePart(
    _ scene: ObjectScene, in geometry: ModelGeometry, for step: TilePart? = nil,
    _ body: (TileInput, StageContext) throws -> Void
  ) throws {
    guard let output = configuration.tiles else {
      throw KernelError.invalidArgument("a part of the tiles needs a folder for them")
    }
    let input = try tileInput(scene, in: geometry, to: output, for: step)
    try recorder.run(.optimization, images: scene.photos.images) { try body(input, $0) }
  }

  private static var noDirectory: KernelError {
    .invalidArgument("a part of a run needs a checkpoint directory")
  }
}

import Kernels
import SceneModel

extension ReconstructionMethod {
  /// Makes a part of the work from the parts before it.
  func make(_ part: RunPart) throws {
    let photos = try ingest()
    switch part {
    case .photos: break
    case .features(let block):
      try alignmentPart(photos) { try $0.makeFeatures(of: block, $1) }
    case .pairs: try alignmentPart(photos) { try $0.selectPairs($1) }
    case .matches(let block): try alignmentPart(photos) { try $0.match(block, $1) }
    case .cameras: _ = try maskObject(photos, try align(photos))
    case .views(let part, let block):
      try make(part, block, of: try maskObject(photos, try align(photos)))
    }
  }

  private func alignmentPart(
    _ photos: PhotoSet, _ body: (AlignmentParts, StageContext) throws -> Void
  ) throws {
    guard let units = cache.units else { throw Self.noDirectory }
    try recorder.run(.imageAlignment, images: photos.images) { context in
      let parts = AlignmentParts(
        alignment: ImageAlignment(configuration.alignmentOptions(for: photos.images)),
        store: units, photos: photos.ingested.photos, images: photos.images)
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

  private static var noDirectory: KernelError {
    .invalidArgument("a part of a run needs a checkpoint directory")
  }
}

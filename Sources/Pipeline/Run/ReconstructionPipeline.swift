import Formats
import Foundation
import Kernels
import SceneModel

/// From photos to textured models: what a session or a command holds.
///
/// Use it from one thread. Stages run when their result is first requested, and later requests share
/// it: five models of one session align once and make the dense cloud once, at the finest level that
/// `plan(for:)` named. The steps are those of `ReconstructionMethod`.
package final class ReconstructionPipeline {
  package let configuration: PipelineConfiguration
  private let source: RunSource
  private let recorder: RunRecorder
  private let cache: StageCache
  private var finestViewPixels = 0
  private var maximumViewPixels = Int.max

  package init(
    _ source: RunSource, configuration: PipelineConfiguration,
    checkpointAccess: CheckpointAccess = .exclusive, flag: CancellationFlag = CancellationFlag(),
    onEvent: @escaping @Sendable (PipelineEvent) -> Void = { _ in }
  ) {
    self.source = source
    self.configuration = configuration
    recorder = RunRecorder(configuration, flag: flag, onEvent: onEvent)
    cache = StageCache(
      directory: configuration.checkpointDirectory, access: checkpointAccess,
      sealsStages: source.isPhotosOnly, recorder: recorder)
  }

  /// What was done so far.
  package var report: RunReport { recorder.report }

  /// Announces the models to come, so that shared stages work at the finest resolution needed.
  package func plan(for specifications: [DetailSpecification]) {
    let requested = max(finestViewPixels, specifications.map(\.viewPixels).max() ?? 0)
    finestViewPixels = min(requested, maximumViewPixels)
  }

  /// Drops results that can be made again, and caps the view resolution: for a retry after an
  /// out-of-memory error.
  package func limitResolution(to viewPixels: Int) {
    maximumViewPixels = max(1, min(maximumViewPixels, viewPixels))
    finestViewPixels = min(finestViewPixels, maximumViewPixels)
    cache.dropReproducible()
    recorder.warn(
      "Memory ran out: from here on views of \(megapixelText(maximumViewPixels)) at most are used. "
        + "Close other programs, or choose a lower detail level.")
  }

  /// Reads and validates the photos.
  package func ingest() throws -> IngestedPhotos { try method().ingest().ingested }

  /// Finds cameras, poses and sparse points, or takes those of the source.
  package func align() throws -> Reconstruction {
    let method = method()
    return try method.align(try method.ingest())
  }

  /// Makes the oriented, colored cloud at the resolution of `specification` or the finest planned.
  package func densify(for specification: DetailSpecification) throws -> PointCloud {
    let method = method(for: specification)
    let photos = try method.ingest()
    return try method.densify(photos, try method.align(photos))
  }

  /// Makes the patches of a share of the views and leaves them in the checkpoint directory, which is
  /// required, for a later `densify(for:)`.
  package func makePatches(
    _ share: PointCloudGeneration.Share, for specification: DetailSpecification
  ) throws {
    let method = method(for: specification)
    let photos = try method.ingest()
    let reconstruction = try method.align(photos)
    try recorder.run(.pointCloudGeneration, images: photos.images) { context in
      guard let folder = cache.checkpoint?.views else {
        throw KernelError.invalidArgument("a share of the views needs a checkpoint directory")
      }
      try PointCloudGeneration(options: method.configuration.pointCloudGeneration)
        .run(share, of: reconstruction, images: photos.images, folder: folder, context)
    }
  }

  /// Makes the surface of the object, or of the whole scene where masking is off, unsimplified.
  package func surface(for specification: DetailSpecification) throws -> Mesh {
    let method = method(for: specification)
    let photos = try method.ingest()
    return try method.surface(photos, try method.align(photos))
  }

  /// Makes a textured model of the part of the surface that `geometry` selects.
  package func model(
    for specification: DetailSpecification, in geometry: ModelGeometry = ModelGeometry()
  ) throws -> TexturedMesh {
    let method = method(for: specification)
    let photos = try method.ingest()
    let reconstruction = try method.align(photos)
    let surface = try method.surface(photos, reconstruction)
    return try method.texture(surface, photos, reconstruction, inside: geometry.crop)
      .transformed(by: geometry.transform)
  }

  /// Makes a model and writes it in the format that the URL names, with the maps that the format has a
  /// place for; and draws it, where the configuration names a preview.
  package func writeModel(
    _ specification: DetailSpecification, in geometry: ModelGeometry = ModelGeometry(), to url: URL
  ) throws {
    var specification = specification
    specification.maps.formIntersection(ModelFormat(of: url).maps)
    try method(for: specification).writeModel(in: geometry, to: url)
    try writeReport()
  }

  /// Writes `report.json` into the checkpoint directory where there is one.
  package func writeReport() throws { try cache.writeReport() }

  /// Lets other runs use the checkpoint directory until this one is used again.
  package func releaseCheckpoint() { cache.unlock() }

  private func method(for specification: DetailSpecification) -> ReconstructionMethod {
    plan(for: [specification])
    return method(configuration.specialized(for: specification, viewPixels: finestViewPixels))
  }

  private func method(_ configuration: PipelineConfiguration? = nil) -> ReconstructionMethod {
    ReconstructionMethod(
      source: source, configuration: configuration ?? self.configuration, cache: cache,
      recorder: recorder)
  }
}

import Formats
import Foundation
import Kernels
import SceneModel

/// From photos to textured models: the pipeline behind a session or a command.
///
/// Use it from a single thread. A stage runs when its result is first requested, and later requests
/// share the result: five models of one session need one alignment and one dense cloud, at the
/// finest level passed to `plan(for:)`. The steps are those of `ReconstructionMethod`.
package final class ReconstructionPipeline {
  package let configuration: PipelineConfiguration
  private let source: RunSource
  private let recorder: RunRecorder
  private let cache: StageCache
  private let collector: MaterialCollector?
  private let flag: CancellationFlag
  private var finestViewPixels = 0
  private var maximumViewPixels = Int.max

  package init(
    _ source: RunSource, configuration: PipelineConfiguration,
    checkpointAccess: CheckpointAccess = .exclusive, flag: CancellationFlag = CancellationFlag(),
    onEvent: @escaping @Sendable (PipelineEvent) -> Void = { _ in }
  ) {
    (self.source, self.flag) = (source, flag)
    self.configuration = configuration
    recorder = RunRecorder(configuration, flag: flag, onEvent: onEvent)
    collector = configuration.keepsReportMaterial ? MaterialCollector() : nil
    cache = StageCache(
      directory: configuration.checkpointDirectory, access: checkpointAccess,
      sealsStages: source.isPhotosOnly, recorder: recorder)
  }

  /// The report of the run so far.
  package var report: RunReport { recorder.report }

  /// What the page of the report shows besides the report; nil unless the configuration asks for
  /// it. Works after a failure, too.
  package func reportMaterial() -> ReportMaterial? {
    guard let collector else { return nil }
    do {
      return try collector.material(
        names: report.photos.map(\.name), images: cache.currentImages, cache.currentReconstruction,
        KernelControl(threadCount: configuration.threadCount, flag: flag))
    } catch is CancellationError {
      // Who interrupts a run doesn't wait for pictures.
      return ReportMaterial()
    } catch {
      recorder.warn("The pictures of the report could not be made (\(error)).")
      return ReportMaterial()
    }
  }

  /// Announces the models that will be requested, so that shared stages work at the highest
  /// resolution needed.
  package func plan(for specifications: [DetailSpecification]) {
    let requested = max(finestViewPixels, specifications.map(\.viewPixels).max() ?? 0)
    finestViewPixels = min(requested, maximumViewPixels)
  }

  /// Drops results that can be recomputed, and limits the view resolution, for a retry after an
  /// out-of-memory error.
  package func limitResolution(to viewPixels: Int) {
    maximumViewPixels = max(1, min(maximumViewPixels, viewPixels))
    finestViewPixels = min(finestViewPixels, maximumViewPixels)
    cache.dropReproducible()
    recorder.warn(
      "Memory ran out: from now on, views have at most \(megapixelText(maximumViewPixels)). "
        + "Close other programs, or choose a lower detail level.")
  }

  /// Reads and validates the photos.
  package func ingest() throws -> IngestedPhotos { try method().ingest().ingested }

  /// Estimates cameras, poses and sparse points, or returns those of the source.
  package func align() throws -> Reconstruction {
    let method = method()
    return try method.align(try method.ingest())
  }

  /// Makes the oriented, colored point cloud at the resolution of the finest planned model, at
  /// least that of `specification`.
  package func densify(for specification: DetailSpecification) throws -> PointCloud {
    let method = method(for: specification)
    let photos = try method.ingest()
    return try method.densify(try method.maskObject(photos, try method.align(photos)))
  }

  /// Makes the patches of a share of the views and stores them in the checkpoint directory, which
  /// is required, for a later `densify(for:)`.
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

  /// Makes a part of the work for a model of `specification`, from the parts before it. Tiles
  /// contain the part of the surface that `geometry` selects. The checkpoint directory, which is
  /// required, holds the results; access is `.parts`.
  package func make(
    _ part: RunPart, for specification: DetailSpecification, in geometry: ModelGeometry
  ) throws {
    try method(for: specification).make(part, in: geometry)
  }

  /// Makes the unsimplified surface of the object, or of the whole scene if masking is off.
  package func surface(for specification: DetailSpecification) throws -> Mesh {
    let method = method(for: specification)
    let photos = try method.ingest()
    return try method.surface(try method.maskObject(photos, try method.align(photos)))
  }

  /// Makes a textured model of the part of the surface that `geometry` selects.
  package func model(
    for specification: DetailSpecification, in geometry: ModelGeometry = ModelGeometry()
  ) throws -> TexturedMesh {
    let method = method(for: specification)
    let photos = try method.ingest()
    let scene = try method.maskObject(photos, try method.align(photos))
    return try method.texture(try method.surface(scene), scene, inside: geometry.crop)
      .transformed(by: geometry.transform)
  }

  /// Makes a model and writes it in the format of the URL's extension, with the maps that the
  /// format supports. Renders a preview and writes tiles if the configuration says where, unless
  /// `hasPreview` is false.
  package func writeModel(
    _ specification: DetailSpecification, in geometry: ModelGeometry = ModelGeometry(),
    to url: URL, hasPreview: Bool = true
  ) throws {
    var specification = specification
    specification.maps.formIntersection(ModelFormat(of: url).maps)
    try method(for: specification, hasPreview: hasPreview)
      .writeModel(in: geometry, to: url, tiles: hasPreview ? configuration.tiles : nil)
    try writeReport()
  }

  /// Writes `report.json` into the checkpoint directory if there is one.
  package func writeReport() throws { try cache.writeReport() }

  /// Unlocks the checkpoint directory for other runs until this pipeline is used again.
  package func releaseCheckpoint() { cache.unlock() }

  private func method(
    for specification: DetailSpecification, hasPreview: Bool = true
  ) -> ReconstructionMethod {
    plan(for: [specification])
    var result = configuration.specialized(for: specification, viewPixels: finestViewPixels)
    if !hasPreview { result.previewFile = nil }
    return method(result)
  }

  private func method(_ configuration: PipelineConfiguration? = nil) -> ReconstructionMethod {
    ReconstructionMethod(
      source: source, configuration: configuration ?? self.configuration, cache: cache,
      recorder: recorder, collector: collector)
  }
}

import Kernels
import Pipeline
import SceneModel

/// This package's engine behind a session: runs the pipeline on a folder or on samples, and
/// converts its results to the session's types.
final class ReconstructionEngine: SessionEngine {
  private let pipeline: ReconstructionPipeline
  private let samples: SampleFolder?
  /// The error of a failed alignment, which would only fail again.
  private var alignmentError: (any Swift.Error)?

  static let make: SessionCore.EngineFactory = { task, flag, onEvent in
    try ReconstructionEngine(task, flag, onEvent)
  }

  private init(
    _ task: EngineTask, _ flag: CancellationFlag, _ onEvent: @escaping SessionCore.EventHandler
  ) throws {
    let configuration = try PipelineConfiguration(session: task.configuration, task.options)
    switch task.input {
    case .folder(let url):
      samples = nil
      pipeline = ReconstructionPipeline(
        .photos(in: url), configuration: configuration,
        checkpointAccess: task.options.sharesCheckpoint ? .shared : .exclusive, flag: flag,
        onEvent: onEvent)
    case .samples(let samples):
      self.samples = samples
      let folder = try samples.write(flag: flag, onEvent: onEvent)
      pipeline = ReconstructionPipeline(
        .photos(in: folder, readings: samples.readings), configuration: configuration, flag: flag
      ) { event in onEvent(samples.translated(event)) }
    }
  }

  var report: RunReport? { pipeline.report }

  func reportMaterial() -> ReportMaterial? { pipeline.reportMaterial() }

  func plan(for specifications: [DetailSpecification]) { pipeline.plan(for: specifications) }

  func finishTask() throws {
    defer { pipeline.releaseCheckpoint() }
    try pipeline.writeReport()
  }

  func limitResolution(to viewPixels: Int) { pipeline.limitResolution(to: viewPixels) }

  func ingest() throws -> PhotoTotals { PhotoTotals(try pipeline.ingest().photos) }

  func poses() throws -> PhotogrammetrySession.Poses {
    PhotogrammetrySession.Poses(try align(), sampleIDs: samples?.ids)
  }

  func pointCloud(
    _ specification: DetailSpecification
  ) throws -> PhotogrammetrySession.PointCloud {
    _ = try align()
    return PhotogrammetrySession.PointCloud(try pipeline.densify(for: specification))
  }

  func bounds(_ specification: DetailSpecification) throws -> BoundingBox {
    _ = try align()
    let mesh = try pipeline.surface(for: specification)
    return mesh.bounds.map { BoundingBox(min: $0.min, max: $0.max) } ?? .empty
  }

  func modelEntity(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry
  ) throws -> ModelEntity {
    _ = try align()
    var specification = specification
    specification.maps.formIntersection(PhysicallyBasedMaterial.maps)
    return ModelEntity(try pipeline.model(for: specification, in: ModelGeometry(geometry)))
  }

  func writeModel(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry,
    to url: URL, hasPreview: Bool
  ) throws {
    _ = try align()
    try pipeline.writeModel(
      specification, in: ModelGeometry(geometry), to: url, hasPreview: hasPreview)
  }

  private func align() throws -> Reconstruction {
    if let alignmentError { throw alignmentError }
    do {
      return try pipeline.align()
    } catch let error as CancellationError {
      throw error
    } catch {
      alignmentError = error
      throw error
    }
  }
}

extension PipelineConfiguration {
  /// The configuration of a session's run, within the limits of the machine. Throws
  /// `OptionOverrideError`.
  init(session configuration: PhotogrammetrySession.Configuration, _ options: EngineOptions) throws
  {
    self.init(configuration, options)
    self = try applying(options.overrides)
  }

  /// The configuration without overrides.
  init(_ configuration: PhotogrammetrySession.Configuration, _ options: EngineOptions) {
    self.init()
    isObjectMaskingEnabled = configuration.isObjectMaskingEnabled
    ingestion.maskFolder = options.maskFolder
    alignment.ordering = SampleOrdering(configuration.sampleOrdering)
    alignment.features.sensitivity = FeatureSensitivity(configuration.featureSensitivity)
    alignment.worldAlignment.knownDistances = options.knownDistances
    alignment.worldAlignment.chosenUp = options.up
    meshGeneration.closesObject = options.closesObject
    if options.refinesSurface { photoRefinement = PhotoRefinement.Options() }
    meshPrimitive = configuration.meshPrimitive == .quad ? .quad : .triangle
    checkpointDirectory = configuration.checkpointDirectory
    previewFile = options.previewFile
    keepsReportMaterial = options.keepsReportMaterial
    export.glbCompression = options.compressesGLB ? GLBCompression() : nil
    maskOutput = options.maskOutput
    tiles = options.tiles
    threadCount = options.threadCount
  }
}

extension SampleOrdering {
  /// Converts the value of a session's configuration.
  package init(_ ordering: PhotogrammetrySession.Configuration.SampleOrdering) {
    self = ordering == .sequential ? .sequential : .unordered
  }
}

extension FeatureSensitivity {
  /// Converts the value of a session's configuration.
  package init(_ sensitivity: PhotogrammetrySession.Configuration.FeatureSensitivity) {
    self = sensitivity == .high ? .high : .normal
  }
}

extension SampleFolder {
  /// Converts an event about files to one about samples.
  fileprivate func translated(_ event: PipelineEvent) -> PipelineEvent {
    if case .rejected(let photo) = event { .rejected(translated(photo)) } else { event }
  }
}

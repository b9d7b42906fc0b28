import Kernels
import Pipeline
import SceneModel

/// The engine of this package behind a session: photos from a folder or from samples, and the
/// pipeline's results in the session's types.
final class ReconstructionEngine: SessionEngine {
  private let pipeline: ReconstructionPipeline
  private let samples: SampleFolder?
  /// An alignment that failed would fail again, only later.
  private var alignmentError: (any Swift.Error)?

  static let make: SessionCore.EngineFactory = { task, flag, onEvent in
    try ReconstructionEngine(task, flag, onEvent)
  }

  private init(
    _ task: EngineTask, _ flag: CancellationFlag, _ onEvent: @escaping SessionCore.EventHandler
  ) throws {
    let configuration = PipelineConfiguration(task.configuration, task.options)
    switch task.input {
    case .folder(let url):
      samples = nil
      pipeline = ReconstructionPipeline(
        folder: url, configuration: configuration, flag: flag, onEvent: onEvent)
    case .samples(let samples):
      self.samples = samples
      let folder = try samples.write(flag: flag, onEvent: onEvent)
      pipeline = ReconstructionPipeline(
        folder: folder, configuration: configuration, readings: samples.readings, flag: flag
      ) { event in onEvent(samples.translated(event)) }
    }
  }

  var report: RunReport? { pipeline.report }

  func plan(for specifications: [DetailSpecification]) { pipeline.plan(for: specifications) }

  func finishTask() throws {
    defer { pipeline.releaseCheckpoint() }
    try pipeline.writeReport()
  }

  func limitResolution(to viewPixels: Int) { pipeline.limitResolution(to: viewPixels) }

  func ingest() throws -> UsualDurations.Photos {
    let photos = try pipeline.ingest().photos
    let pixels = photos.reduce(0) { $0 + Double($1.width * $1.height) }
    return .init(count: photos.count, megapixels: pixels / 1e6)
  }

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
    to url: URL
  ) throws {
    _ = try align()
    try pipeline.writeModel(specification, in: ModelGeometry(geometry), to: url)
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
  init(_ configuration: PhotogrammetrySession.Configuration, _ options: EngineOptions) {
    self.init()
    isObjectMaskingEnabled = configuration.isObjectMaskingEnabled
    isSequential = configuration.sampleOrdering == .sequential
    isHighSensitivity = configuration.featureSensitivity == .high
    checkpointDirectory = configuration.checkpointDirectory
    meshPrimitive = configuration.meshPrimitive == .quad ? .quad : .triangle
    threadCount = options.threadCount
    knownDistances = options.knownDistances
    previewFile = options.previewFile
    maskFolder = options.maskFolder
    closesObject = options.closesObject
    refinesSurface = options.refinesSurface
    maximumPhotos = PhotogrammetrySession.limits.maximumNumberOfInputImages
    maximumPhotoSide = PhotogrammetrySession.limits.maximumInputImageDimension
    // The machine's memory and not what is free of it: runs must not differ.
    imageMemory = min(imageMemory, max(256 << 20, Machine.current.totalMemoryBytes / 8))
  }
}

extension SampleFolder {
  /// An event about files as one about samples.
  fileprivate func translated(_ event: PipelineEvent) -> PipelineEvent {
    if case .refused(let photo) = event { .refused(translated(photo)) } else { event }
  }
}

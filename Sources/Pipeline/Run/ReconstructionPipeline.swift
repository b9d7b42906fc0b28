import Foundation
import Formats
import Kernels
import SceneModel

/// From a folder of photos to a textured model, stage by stage; every result is made once.
///
/// Use it from one thread. Stages run when their result is first asked for, and later requests
/// share it: five models of one session align once and make the dense cloud once, at the finest
/// level that `plan(for:)` named.
package final class ReconstructionPipeline {
  package let configuration: PipelineConfiguration
  /// What was done so far.
  package private(set) var report: RunReport

  private let folder: URL
  private let knownCameras: KnownCameras?
  private let readings: [Int: SensorReading]
  private let saved: SavedRun?
  private let flag: CancellationFlag
  private let onEvent: @Sendable (PipelineEvent) -> Void
  private var finestViewPixels = 0
  private var maximumViewPixels = Int.max
  /// Others may work in the checkpoint directory at the same time.
  private var sharesCheckpoint = false

  private var lock: DirectoryLock?
  private var store: StageStore?
  private var notes: [PipelineStage: StageNotes] = [:]
  private var ingested: IngestedPhotos?
  private var images: ImageStore?
  private var reconstruction: Reconstruction?
  private var cloud: (viewPixels: Int, value: PointCloud)?
  private var surface: (viewPixels: Int, value: Mesh)?

  /// With `knownCameras` photos aren't aligned: these cameras, poses and points are used, unmoved.
  /// `readings` are by sample id.
  package init(
    folder: URL, configuration: PipelineConfiguration, knownCameras: KnownCameras? = nil,
    readings: [Int: SensorReading] = [:], flag: CancellationFlag = CancellationFlag(),
    onEvent: @escaping @Sendable (PipelineEvent) -> Void = { _ in }
  ) {
    self.folder = folder
    self.knownCameras = knownCameras
    self.readings = readings
    saved = nil
    self.configuration = configuration
    self.flag = flag
    self.onEvent = onEvent
    report = RunReport(configuration: configuration)
  }

  /// Makes models of the surface that an earlier run made; nothing that comes before is made again.
  package init(
    _ saved: SavedRun, configuration: PipelineConfiguration,
    flag: CancellationFlag = CancellationFlag(),
    onEvent: @escaping @Sendable (PipelineEvent) -> Void = { _ in }
  ) {
    folder = saved.photoFolder
    knownCameras = nil
    readings = [:]
    self.saved = saved
    self.configuration = configuration
    self.flag = flag
    self.onEvent = onEvent
    report = RunReport(configuration: configuration)
  }

  /// Announces the models to come, so that shared stages work at the finest resolution needed.
  package func plan(for specifications: [DetailSpecification]) {
    let wished = max(finestViewPixels, specifications.map(\.viewPixels).max() ?? 0)
    finestViewPixels = min(wished, maximumViewPixels)
  }

  /// Lets go of what can be made again, and uses at most so many pixels of a view from now on: for a
  /// run that memory was too short for.
  package func limitResolution(to viewPixels: Int) {
    maximumViewPixels = max(1, min(maximumViewPixels, viewPixels))
    finestViewPixels = min(finestViewPixels, maximumViewPixels)
    cloud = nil
    images = ingested.map { imageStore(of: $0) }
    let sentence =
      "Memory ran out: from here on views of \(megapixels(maximumViewPixels)) at most are used. "
      + "Close other programs, or choose a lower detail level."
    report.warnings.append(sentence)
    onEvent(.warning(sentence))
  }

  /// Reads and validates the photos.
  package func ingest() throws -> IngestedPhotos {
    try noting { try lockCheckpoint() }
    if let ingested { return ingested }
    let result = try run(.preProcessing) { context in
      if let saved { return try SavedPhotos().run(saved, context) }
      var options = PhotoIngestion.Options()
      options.memoryBudget = configuration.imageMemory
      options.maximumPhotos = configuration.maximumPhotos
      options.maskFolder = configuration.maskFolder
      options.inspection.usesMasks = configuration.isObjectMaskingEnabled
      options.inspection.limits.maximumSide = configuration.maximumPhotoSide
      return try PhotoIngestion(options).run(folder: folder, context)
    }
    report.photos += result.refused.map {
      .init(name: $0.name, status: .refused, reason: $0.reason)
    }
    result.refused.forEach { onEvent(.refused($0)) }
    if result.isDownsampled { onEvent(.downsampled) }
    try noting { try checkCount(result) }
    ingested = result
    images = imageStore(of: result)
    try prepareStore(result)
    return result
  }

  /// Shares of a dense stage, and models of a run that is over, may be made at the same time.
  private func lockCheckpoint() throws {
    guard lock == nil, let checkpoint else { return }
    lock = try DirectoryLock(checkpoint.directory, isShared: sharesCheckpoint)
    checkpoint.removeRemains()
  }

  private func prepareStore(_ ingested: IngestedPhotos) throws {
    guard let checkpoint, saved == nil, knownCameras == nil else { return }
    store = StageStore(
      checkpoint: checkpoint,
      inputs: try RunInputs(ingested, configuration, readings: readings(ingested)))
  }

  /// What the caller knows, else what lies beside the photos.
  private func readings(_ ingested: IngestedPhotos) -> [Int: SensorReading] {
    readings.merging(ingested.readings) { known, _ in known }
  }

  private func imageStore(of ingested: IngestedPhotos, isMasked: Bool = true) -> ImageStore {
    var photos = ingested.photos
    if !isMasked { for index in photos.indices { photos[index].mask = nil } }
    return ImageStore(
      photos: photos, byteBudget: configuration.imageMemory,
      processingPixels: ingested.processingPixels, contentHashes: ingested.contentHashes)
  }

  /// Finds cameras, poses and sparse points in the frame that everything else shares, or takes those
  /// that are known.
  package func align() throws -> Reconstruction {
    if let reconstruction { return reconstruction }
    let result = try saved.map(reuse) ?? knownCameras.map(adopt) ?? findCameras()
    reconstruction = result
    return result
  }

  private func findCameras() throws -> Reconstruction {
    let (ingested, images) = try input()
    let result = try run(.imageAlignment) { context in
      if let found = store?.reconstruction(of: ingested.photos, context.notes) { return found }
      let found = try findCameras(ingested, images, context)
      try store?.save(found, context.notes)
      return found
    }
    describe(result)
    try checkpoint?.write(result)
    return result
  }

  private func findCameras(
    _ ingested: IngestedPhotos, _ images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    var options = ImageAlignment.Options()
    options.isSequential = configuration.isSequential
    options.isHighSensitivity = configuration.isHighSensitivity
    options.worldAlignment.knownDistances = configuration.knownDistances
    options.worldAlignment.readings = readings(ingested)
    options.mapping.method = configuration.mappingMethod
    return try MaskedAlignment(ImageAlignment(options))
      .run(
        ingested, images: images, wholePhotos: { imageStore(of: ingested, isMasked: false) },
        context)
  }

  /// Gives the photos the known cameras, and finds sparse points where none came with them. No
  /// checkpoint is written: the cameras may have been read from there.
  private func adopt(_ known: KnownCameras) throws -> Reconstruction {
    let (ingested, images) = try input()
    let (result, missing) = try run(.imageAlignment) { context in
      let assigned = try CameraAssignment()
        .run(known, to: ingested, context.part(from: 0, to: 0.01))
      let result = try KnownPoints().run(
        assigned.reconstruction, images: images, context.part(from: 0.01, to: 1))
      return (result, assigned.missing)
    }
    report.photos += missing.map { .init(name: $0, status: .missing, reason: nil) }
    describe(result)
    return result
  }

  private func reuse(_ saved: SavedRun) throws -> Reconstruction {
    let result = saved.reconstruction(of: try ingest())
    describe(result)
    return result
  }

  private var denseOptions: PointCloudGeneration.Options {
    var options = configuration.pointCloudGeneration
    options.maximumPixelsPerView = finestViewPixels
    return options
  }

  /// Makes the oriented, coloured cloud at `specification`'s resolution or the finest planned.
  package func densify(for specification: DetailSpecification) throws -> PointCloud {
    plan(for: [specification])
    if let cloud, cloud.viewPixels >= finestViewPixels { return cloud.value }
    let (_, images) = try input()
    let reconstruction = try align()
    let result = try run(.pointCloudGeneration) { context in
      let cloud = try PointCloudGeneration(options: denseOptions)
        .run(reconstruction, images: images, folder: checkpoint?.views, context)
      CloudMetrics().run(cloud, reconstruction, context.notes)
      return cloud
    }
    try checkpoint?.write(result)
    cloud = (finestViewPixels, result)
    return result
  }

  /// Makes the patches of a share of the views and leaves them in the checkpoint directory, which must
  /// be there, for `densify(for:)` to go on with.
  package func makePatches(
    _ share: PointCloudGeneration.Share, for specification: DetailSpecification
  ) throws {
    plan(for: [specification])
    sharesCheckpoint = true
    let (_, images) = try input()
    let reconstruction = try align()
    try run(.pointCloudGeneration) { context in
      guard let folder = checkpoint?.views else {
        throw KernelError.invalidArgument("a share of the views needs a checkpoint directory")
      }
      try PointCloudGeneration(options: denseOptions)
        .run(share, of: reconstruction, images: images, folder: folder, context)
    }
  }

  /// Makes the surface of the object, or of everything where masking is off, unsimplified.
  package func surface(for specification: DetailSpecification) throws -> Mesh {
    plan(for: [specification])
    if let surface, surface.viewPixels >= finestViewPixels { return surface.value }
    if let saved { return reuseSurface(saved) }
    let reconstruction = try align()
    let kept = try keptSurface()
    let result = try kept ?? makeSurface(for: specification, reconstruction)
    surface = (finestViewPixels, result)
    if kept == nil { try save(result) }
    try saveRecord(of: reconstruction)
    return result
  }

  /// The surface that an earlier run with the same photos and options has left.
  private func keptSurface() throws -> Mesh? {
    guard let store else { return nil }
    let found = StageNotes()
    guard let mesh = store.surface(viewPixels: finestViewPixels, found) else { return nil }
    onEvent(.progress(.pointCloudGeneration, fraction: 1))
    return try run(.meshGeneration) { context in
      context.notes.add(found)
      return mesh
    }
  }

  private func makeSurface(
    for specification: DetailSpecification, _ reconstruction: Reconstruction
  ) throws -> Mesh {
    let (_, images) = try input()
    let cloud = try densify(for: specification)
    return try run(.meshGeneration) { context in
      var options = MeshGeneration.Options(viewPixels: finestViewPixels)
      options.isolatesObject = configuration.isObjectMaskingEnabled
      options.closesObject = configuration.closesObject
      let silhouettes = try Silhouettes(reconstruction, images: images)
      let share = configuration.refinesSurface ? 0.4 : 1
      let mesh = try MeshGeneration(options)
        .run(
          cloud, reconstruction, silhouettes: silhouettes, context.part(from: 0, to: share))
      guard configuration.refinesSurface else { return mesh }
      return try PhotoRefinement(options: .init(viewPixels: finestViewPixels))
        .run(
          mesh, source: ViewSource(reconstruction, images: images), context.part(from: share, to: 1)
        )
    }
  }

  private func save(_ surface: Mesh) throws {
    checkpoint?.removeRecord()
    try checkpoint?.write(surface)
    try store?.sealSurface(
      viewPixels: finestViewPixels, notes[.meshGeneration] ?? StageNotes(),
      denseNotes: notes[.pointCloudGeneration] ?? StageNotes())
  }

  private func saveRecord(of reconstruction: Reconstruction) throws {
    guard let checkpoint, let sparseHash = checkpoint.sparseHash else { return }
    try checkpoint.write(
      SurfaceRecord(
        reconstruction, of: try ingest(), in: folder, viewPixels: finestViewPixels,
        sparseHash: sparseHash))
  }

  private func reuseSurface(_ saved: SavedRun) -> Mesh {
    let (had, wanted) = (saved.record.viewPixels, finestViewPixels)
    if had < wanted {
      let sentence =
        "The surface was made from views of \(megapixels(had)), not \(megapixels(wanted)) as for "
        + "this level, and has no more detail than that. Run the photos again at this level for more."
      report.warnings.append(sentence)
      onEvent(.warning(sentence))
    }
    surface = (wanted, saved.surface)
    return saved.surface
  }

  /// Simplifies the surface to the budget and textures it; `geometry` says what part of it, and where
  /// it is put.
  package func model(
    for specification: DetailSpecification, in geometry: ModelGeometry = ModelGeometry()
  ) throws -> TexturedMesh {
    try croppedModel(for: specification, to: geometry.crop).transformed(by: geometry.transform)
  }

  private func croppedModel(
    for specification: DetailSpecification, to box: OrientedBox?
  ) throws -> TexturedMesh {
    let (_, images) = try input()
    let reconstruction = try align()
    let surface = try surface(for: specification)
    return try run(.textureMapping) { context in
      let parts = box.map { MeshCropping(box: $0).run(surface) }
      let dense = parts?.inside ?? surface
      guard !dense.triangles.isEmpty else { throw PipelineError.emptyCrop }
      let mesh = try Simplification(
        options: .init(maximumTriangles: specification.maximumTriangles)
      ).run(dense, context.part(from: 0, to: 0.15))
      return try TextureMapping(
        options: .init(
          textureSide: specification.textureSide, maximumAtlases: specification.maximumAtlases,
          maps: specification.maps)
      ).run(
        mesh, dense: dense, occluders: parts?.outside ?? Mesh(), reconstruction: reconstruction,
        images: images, context.part(from: 0.15, to: 1))
    }
  }

  /// Makes a model and writes it as `ModelFormat` reads from the URL, with the maps that the format
  /// has a place for; and draws it, where the configuration says so.
  package func writeModel(
    _ specification: DetailSpecification, in geometry: ModelGeometry = ModelGeometry(), to url: URL
  ) throws {
    var specification = specification
    specification.maps.formIntersection(ModelFormat(of: url).maps)
    let model = try croppedModel(for: specification, to: geometry.crop)
    let cameras = try align().poses.compactMap { $0 }
    try run(.optimization) { context in
      let end = configuration.previewFile == nil ? 1 : 0.7
      try ModelExport(options: .init(textureFormat: specification.textureFormat))
        .run(
          try faces(of: model, context).transformed(by: geometry.transform), to: url,
          context.part(from: 0, to: end))
      if let file = configuration.previewFile {
        // Where the cameras are.
        try ModelPreview().write(
          model, cameras: cameras, to: file, context.part(from: end, to: 1))
      }
    }
    try writeReport()
  }

  private func faces(of model: TexturedMesh, _ context: StageContext) throws -> TexturedMesh {
    switch configuration.meshPrimitive {
    case .triangle: model
    case .quad: try QuadPairing().run(model, context.part(from: 0, to: 0))
    }
  }

  /// Writes `report.json` into the checkpoint directory where there is one.
  package func writeReport() throws {
    // The directory may be another run's.
    guard lock != nil else { return }
    try checkpoint?.write(report)
  }

  /// Lets other runs use the checkpoint directory until this one is asked for more.
  package func releaseCheckpoint() { lock = nil }
}

extension ReconstructionPipeline {
  private var checkpoint: Checkpoint? { configuration.checkpointDirectory.map(Checkpoint.init) }

  private func input() throws -> (IngestedPhotos, ImageStore) {
    let photos = try ingest()
    guard let images else { preconditionFailure("ingest() makes the image store") }
    return (photos, images)
  }

  /// Throws where there are too few photos for anything.
  private func checkCount(_ photos: IngestedPhotos) throws {
    let (count, needed) = (photos.photos.count, 3)
    guard count > 0 else {
      throw PipelineError.noPhotos(folder: folder.path, refused: photos.refused.count)
    }
    onEvent(.ingested(photos: count))
    guard count >= needed else {
      throw PipelineError.tooFewPhotos(found: count, needed: needed)
    }
  }

  /// Puts into the report why `body` fails.
  private func noting<Value>(_ body: () throws -> Value) throws -> Value {
    do {
      return try body()
    } catch {
      report.note(error)
      throw error
    }
  }

  /// Runs one stage with its own progress and notes, and puts what it cost into the report.
  private func run<Value>(
    _ stage: PipelineStage, _ body: (StageContext) throws -> Value
  ) throws -> Value {
    let notes = StageNotes()
    let control = KernelControl(threadCount: configuration.threadCount, flag: flag) {
      [onEvent] fraction in onEvent(.progress(stage, fraction: fraction))
    }
    self.notes[stage] = notes
    let start = ResourceUsage.now
    try noting { try control.step(0) }
    defer {
      let end = ResourceUsage.now
      report.stages.append(
        .init(
          name: stage.rawValue, seconds: end.seconds - start.seconds,
          cpuSeconds: end.cpuSeconds - start.cpuSeconds, peakMemoryBytes: end.peakMemoryBytes,
          counts: notes.counts))
      report.warnings += notes.warnings
      report.details += notes.details
      notes.warnings.forEach { onEvent(.warning($0)) }
      notes.details.forEach { onEvent(.detail($0)) }
    }
    return try noting {
      let value = try body(StageContext(control: control, notes: notes))
      try control.step(1)
      return value
    }
  }

  private func describe(_ reconstruction: Reconstruction) {
    report.photos += reconstruction.registered.map {
      .init(name: reconstruction.photos[$0.index].name, status: .registered, reason: nil)
    }
    report.photos += reconstruction.unregistered.map {
      .init(name: $0.name, status: .notRegistered, reason: $0.reason)
    }
    report.photos.sort { $0.name < $1.name }
    report.meanReprojectionError = reconstruction.meanReprojectionError
    report.worldFrame = reconstruction.worldFrame
    reconstruction.unregistered.forEach { onEvent(.refused($0)) }
    let (registered, all) = (reconstruction.registered.count, reconstruction.photos.count)
    if registered < all { onEvent(.stitchingIncomplete(registered: registered, of: all)) }
  }
}

private func megapixels(_ pixels: Int) -> String { "\(Double(pixels / 10_000) / 100) MP" }

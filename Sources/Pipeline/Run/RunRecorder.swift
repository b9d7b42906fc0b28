import Foundation
import Kernels
import SceneModel

/// Records what a run does: sends its events, measures its stages and fills its report.
///
/// Used on the run's thread only; `onEvent` may be called from any thread.
final class RunRecorder {
  private(set) var report: RunReport
  /// The notes of the latest execution of each stage.
  private(set) var notes: [PipelineStage: StageNotes] = [:]

  /// The names of the photos that are used, by photo ID.
  private var photoNames: [String] = []
  private let threadCount: Int
  private let flag: CancellationFlag
  private let onEvent: @Sendable (PipelineEvent) -> Void
  /// The uptime at which the run began.
  private let beginning = ResourceUsage.now.seconds
  /// The cameras of the photos before alignment, by photo ID.
  private var initialCameras: [Camera] = []
  private let memory = Locked(MemoryRecord())

  init(
    _ configuration: PipelineConfiguration, flag: CancellationFlag,
    onEvent: @escaping @Sendable (PipelineEvent) -> Void
  ) {
    report = RunReport(configuration: configuration)
    threadCount = configuration.threadCount
    self.flag = flag
    self.onEvent = onEvent
  }

  func send(_ event: PipelineEvent) { onEvent(event) }

  /// Records a warning that concerns no particular stage, as a sentence.
  func warn(_ sentence: String) {
    report.warnings.append(sentence)
    onEvent(.warning(sentence))
  }

  /// Adds the error to the report if `body` throws.
  func recordingErrors<Value>(_ body: () throws -> Value) throws -> Value {
    do {
      return try body()
    } catch {
      report.note(error)
      throw error
    }
  }

  /// For work between stages, which has no progress.
  var control: KernelControl { KernelControl(threadCount: threadCount, flag: flag) }

  /// Runs a stage with separate progress and notes, and adds its cost to the report. `images` is
  /// the store that the stage decodes photos with.
  func run<Value>(
    _ stage: PipelineStage, images: ImageStore? = nil, _ body: (StageContext) throws -> Value
  ) throws -> Value {
    let meter = SerialTimeMeter()
    let memoryThread = recordingMemory()
    defer {
      meter.stop()
      memoryThread.stop()
    }
    let notes = StageNotes(meter: meter)
    let control = KernelControl(threadCount: threadCount, flag: flag) { [onEvent] fraction in
      onEvent(.progress(stage, fraction: fraction))
    }
    self.notes[stage] = notes
    let start = ResourceUsage.now
    let decodeCount = images?.decodeCount
    images?.startStage()
    try recordingErrors { try control.step(0) }
    defer {
      if let images, let decodeCount {
        notes.record("decodedPhotos", Double(images.decodeCount - decodeCount))
      }
      add(stage, notes, since: start)
    }
    return try recordingErrors {
      let context = StageContext(control: control, notes: notes) { [onEvent] factor in
        onEvent(.extended(stage, by: factor))
      }
      let value = try body(context)
      try control.step(1)
      return value
    }
  }

  /// A thread that records the resident memory until it is stopped.
  private func recordingMemory() -> PeriodicThread {
    let (memory, beginning) = (memory, beginning)
    @Sendable func sample() {
      guard let bytes = ResourceUsage.residentBytes else { return }
      let time = ResourceUsage.now.seconds - beginning
      memory.withLock { $0.add(bytes, at: time) }
    }
    sample()
    return PeriodicThread("memory", interval: MemoryRecord.shortestInterval, sample)
  }

  private func add(_ stage: PipelineStage, _ notes: StageNotes, since start: ResourceUsage) {
    let end = ResourceUsage.now
    report.stages.append(
      .init(
        name: stage.rawValue, start: start.seconds - beginning,
        seconds: end.seconds - start.seconds,
        cpuSeconds: end.cpuSeconds - start.cpuSeconds,
        serialSeconds: notes.meter?.serialSeconds ?? 0, peakMemoryBytes: end.peakMemoryBytes,
        counts: notes.counts, steps: notes.steps))
    report.memory = memory.withLock { $0 }
    report.warnings += notes.warnings
    report.concerns += notes.concerns
    report.details += notes.details
    if let matches = notes.matches { report.add(matches, of: photoNames) }
    notes.warnings.forEach { onEvent(.warning($0)) }
    notes.details.forEach { onEvent(.detail($0)) }
  }
}

// MARK: - Photos

extension RunRecorder {
  /// Records which photos of a folder are used; throws if there are fewer than `minimumPhotos`.
  /// They have no pose yet.
  func record(_ ingested: IngestedPhotos, folder: URL, minimumPhotos: Int) throws {
    report.add(ingested)
    photoNames = ingested.photos.map(\.name)
    initialCameras = ingested.photos.map { ingested.cameras[$0.camera.index] }
    ingested.rejected.forEach { onEvent(.rejected($0)) }
    if ingested.isDownsampled { onEvent(.downsampled) }
    try recordingErrors {
      guard !ingested.photos.isEmpty else {
        throw PipelineError.noPhotos(folder: folder.path, rejected: ingested.rejected.count)
      }
      onEvent(.ingested(PhotoTotals(ingested.photos)))
      try PipelineError.checkCount(ingested.photos.count, needed: minimumPhotos)
    }
  }

  /// Records cameras without a photo, by name.
  func record(missing names: [String]) {
    report.photos += names.map { .init(name: $0, status: .missing, reason: nil) }
  }

  /// Records how sure the estimated masks are; `names` are those of the photos, by ID.
  func record(_ masks: EstimatedMasks, names: [String]) {
    report.update(names) { photo, entry in
      if photo < masks.agreement.count { entry.maskAgreement = masks.agreement[photo] }
      if photo < masks.masks.count { entry.maskShare = masks.masks[photo]?.coverage }
    }
  }

  /// Records how the photos show the surface of a model, and where photos are missing.
  func record(
    _ evidence: ModelEvidence, _ statistics: SurfaceStatistics, _ advice: [Advice]
  ) {
    report.surface = statistics
    report.advice.removeAll { $0.kind == .surface }
    report.advice += advice
    let shares = evidence.areaShares
    report.update(photoNames) { photo, entry in
      entry.exposure = evidence.gains[ID(photo)].map { -Double(log2($0)) }
      entry.textureShare = evidence.gains[ID(photo)].map { _ in shares[ID(photo)] ?? 0 }
    }
  }

  /// Records which photos are registered, and the reprojection errors.
  func record(_ reconstruction: Reconstruction) {
    let residuals = reconstruction.residuals.map { $0.map(\.offset.length) }
    report.update(reconstruction.photos.map(\.name)) { photo, entry in
      guard let pose = reconstruction.poses[photo] else { return }
      let residuals = residuals[photo]
      entry.status = .registered
      entry.camera = reconstruction.photos[photo].camera.index
      entry.position = pose.center
      let rotation = pose.rotation.conjugate
      entry.rotation = [rotation.w, rotation.x, rotation.y, rotation.z]
      entry.observations = residuals.count
      entry.meanResidual =
        residuals.isEmpty ? nil : residuals.reduce(0, +) / Double(residuals.count)
      entry.residual95 = residuals.quantile(0.95)
    }
    let unregistered = reconstruction.unregistered
    report.update(unregistered.map(\.name)) {
      ($1.reason, $1.fault) = (unregistered[$0].reason, unregistered[$0].fault)
    }
    report.photos.sort { $0.name < $1.name }
    report.cameras = CameraEntry.entries(of: reconstruction, initial: initialCameras)
    report.tracks = TrackStatistics(reconstruction, residuals: residuals)
    report.meanReprojectionError = reconstruction.meanReprojectionError
    report.worldFrame = reconstruction.worldFrame
    unregistered.forEach { onEvent(.rejected($0)) }
    let (registered, all) = (reconstruction.registered.count, reconstruction.photos.count)
    if registered < all { onEvent(.stitchingIncomplete(registered: registered, of: all)) }
  }
}

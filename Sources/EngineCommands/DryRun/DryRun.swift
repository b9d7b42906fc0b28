import Formats
import Foundation
import Kernels
import Pipeline
import SharedCommands

/// What `reconstruct` would do, and how long it would take.
struct DryRun {
  let report: InspectionReport
  /// The model that would be written.
  let output: ModelOutput
  /// The models at lower levels that would be written with it.
  let coarserModels: [CoarserModel]
  let limits: DetailSpecification
  /// The usual duration of the run in seconds.
  let expectedSeconds: Double
  let threadCount: Int
  /// The usual peak memory of the run and the free memory, in bytes.
  let memory: (needed: Int, free: Int)
  /// The maximum disk space of the model and the free disk space, in bytes.
  let space: (needed: Int, free: Int?)

  /// Reads and checks all photos and masks.
  init(
    _ arguments: ReconstructArguments<PipelineArguments>, photos folder: URL,
    output: ModelOutput
  ) throws {
    var configuration = PipelineConfiguration()
    arguments.engine.runArguments.threading.apply(to: &configuration)
    try arguments.engine.masking.apply(
      to: &configuration, areIgnored: arguments.noObjectMasking)
    try arguments.engine.scale.apply(to: &configuration, photos: folder)
    threadCount = configuration.threadCount
    let ingested = try PhotoIngestion(configuration.ingestion).run(
      folder: folder, StageContext(control: KernelControl(threadCount: threadCount)))
    report = InspectionReport(ingested)
    self.output = output
    coarserModels = try CoarserModel.all(arguments.detail, nextTo: output)
    limits = arguments.detail.limits
    let coarser = coarserModels.map(\.level.limits)
    let durations = StageDurationModel(
      photos: PhotoTotals(ingested.photos), finest: limits, threadCount: threadCount,
      masksObject: configuration.isObjectMaskingEnabled,
      makesTiles: arguments.engine.tiles.tiles != nil)
    expectedSeconds = coarser.reduce(durations.total) { sum, limits in
      [.textureMapping, .optimization].reduce(sum) {
        $0 + durations.seconds(of: WorkUnit(stage: $1, specification: limits))
      }
    }
    memory = (arguments.detail.detail.expectedMemoryBytes, Machine.current.availableMemoryBytes)
    let system = try? FileManager.default.attributesOfFileSystem(
      forPath: output.url.absoluteURL.deletingLastPathComponent().path)
    space = (
      coarser.reduce(limits.modelBytes(in: output.format)) { sum, limits in
        let (total, isTooLarge) = sum.addingReportingOverflow(limits.modelBytes(in: output.format))
        return isTooLarge ? .max : total
      }, (system?[.systemFreeSize] as? NSNumber)?.intValue
    )
  }

  /// The reasons why the run could not succeed, as sentences with a remedy.
  var faults: [String] {
    var faults = Machine.current.shortfalls
    do { try report.checkCount() } catch { faults.append(CommandFailure(error).sentence) }
    if let free = space.free, free < space.needed {
      faults.append(
        "The disk of \(output.url.relativePath) has \(Self.megabytes(free)) free, and the model "
          + "may take \(Self.megabytes(space.needed)). Free some space or choose another disk.")
    }
    return faults
  }

  /// The plan as text.
  var lines: [String] {
    let models = coarserModels.map { ($0.output, $0.level.limits) } + [(output, limits)]
    let written = models.map { output, limits in
      "\(output.url.relativePath) would be written: at most \(limits.maximumTriangles) triangles "
        + "and textures of \(limits.textureSide) x \(limits.textureSide)."
    }
    return report.lines + written + [
      "It would take about \(RunProgress.duration(expectedSeconds)) with \(threadCount) "
        + "thread\(threadCount == 1 ? "" : "s"), "
        + "at most \(Self.megabytes(memory.needed)) of memory "
        + "(\(Self.megabytes(memory.free)) free) and at most "
        + "\(Self.megabytes(space.needed)) of disk space"
        + (space.free.map { " (\(Self.megabytes($0)) free)." } ?? ".")
    ]
  }

  /// The plan as events: the files that would not be used, then the event `plan`.
  var events: [RunEvent] {
    let refused = report.refused.map { photo in
      RunEvent("invalidSample") { $0.reason = photo.reason }
    }
    let masks = report.refusedMasks.map { mask in RunEvent("warning") { $0.message = mask.reason } }
    let plan = RunEvent("plan") {
      ($0.path, $0.photos) = (output.url.relativePath, report.used.count)
      $0.expectedSeconds = expectedSeconds
      ($0.memoryBytes, $0.diskBytes) = (memory.needed, space.needed)
    }
    return refused + masks + [plan]
  }

  private static func megabytes(_ bytes: Int) -> String { "\(bytes / 1_000_000) MB" }
}

extension DetailSpecification {
  /// The maximum size of a model in bytes: barely compressed textures, and vertices with all
  /// attributes. At most `Int.max`: users may allow any number of triangles.
  func modelBytes(in format: ModelFormat) -> Int {
    let (mesh, isTooLarge) = maximumTriangles.multipliedReportingOverflow(by: 60)
    let maps = format == .ply ? 0 : maps.intersection(format.maps).count
    let (sum, isSumTooLarge) = mesh.addingReportingOverflow(
      maximumAtlases * textureSide * textureSide * 3 * maps)
    return isTooLarge || isSumTooLarge ? .max : sum
  }
}

import Foundation
import Kernels
import SceneModel

@testable import Pipeline
@testable import RealityFoundation

/// An engine that follows a test's script and does no work.
final class ScriptedEngine: SessionEngine {
  /// The behavior of the engine.
  struct Script: Sendable {
    var photos = 12
    var rejected: [RejectedPhoto] = []
    var ingestError: PipelineError?
    var alignmentError: PipelineError?
    var entityError: PipelineError?
    /// A model needs fewer pixels per view than this to fit into memory.
    var pixelsInMemory = Int.max
    var isDownsampled = false
    var registered: Int?
    /// Repeats the alignment until it is canceled.
    var repeatsUntilCanceled = false
  }

  /// A thread-safe record of the engines made and the calls they received.
  final class Journal: Sendable {
    private let entries = Locked<[String]>([])

    func add(_ entry: String) { entries.withLock { $0.append(entry) } }
    func count(of entry: String) -> Int { entries.withLock { $0.filter { $0 == entry }.count } }
  }

  private let script: Script
  private let flag: CancellationFlag
  private let journal: Journal
  private var maximumViewPixels = Int.max
  private let onEvent: SessionCore.EventHandler

  init(
    _ script: Script, _ flag: CancellationFlag, _ journal: Journal,
    _ onEvent: @escaping SessionCore.EventHandler
  ) {
    self.script = script
    self.flag = flag
    self.journal = journal
    self.onEvent = onEvent
    journal.add("made")
  }

  deinit { journal.add("gone") }

  private func work(_ stage: PipelineStage) throws {
    for step in 1...10 {
      if flag.isCancelled { throw CancellationError() }
      onEvent(.progress(stage, fraction: Double(step) / 10))
    }
  }

  private func align() throws {
    journal.add("align")
    while script.repeatsUntilCanceled {
      try work(.imageAlignment)
      Thread.sleep(forTimeInterval: 0.001)
    }
    try work(.imageAlignment)
    if let error = script.alignmentError { throw error }
    if let registered = script.registered {
      onEvent(.stitchingIncomplete(registered: registered, of: script.photos))
    }
  }

  func plan(for specifications: [DetailSpecification]) {}

  func ingest() throws -> PhotoTotals {
    journal.add("ingest")
    for photo in script.rejected { onEvent(.rejected(photo)) }
    if let error = script.ingestError { throw error }
    if script.isDownsampled { onEvent(.downsampled) }
    try work(.preProcessing)
    return .init(count: script.photos)
  }

  func poses() throws -> PhotogrammetrySession.Poses {
    try align()
    return PhotogrammetrySession.Poses(posesBySample: [:], urlsBySample: [:])
  }

  func pointCloud(
    _ specification: DetailSpecification
  ) throws -> PhotogrammetrySession.PointCloud {
    try align()
    try work(.pointCloudGeneration)
    return PhotogrammetrySession.PointCloud(PointCloud())
  }

  func bounds(_ specification: DetailSpecification) throws -> BoundingBox {
    try align()
    try work(.meshGeneration)
    return BoundingBox(min: .zero, max: .one)
  }

  func modelEntity(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry
  ) throws -> ModelEntity {
    try align()
    if let error = script.entityError { throw error }
    if min(specification.viewPixels, maximumViewPixels) >= script.pixelsInMemory {
      throw KernelError.outOfMemory
    }
    for stage in PipelineStage.allCases[2..<6] { try work(stage) }
    return ModelEntity()
  }

  func writeModel(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry,
    to url: URL, hasPreview: Bool
  ) throws {
    try align()
    for stage in PipelineStage.allCases.dropFirst(2) { try work(stage) }
    try Data("model".utf8).write(to: url)
  }

  func limitResolution(to viewPixels: Int) {
    journal.add("limited to \(viewPixels)")
    maximumViewPixels = viewPixels
  }

  func finishTask() throws { journal.add("finished") }

  var report: RunReport? { RunReport(configuration: PipelineConfiguration()) }

  func reportMaterial() -> ReportMaterial? { nil }
}

extension PhotogrammetrySession {
  /// A session on a folder with a scripted engine.
  convenience init(
    folder: URL, _ script: ScriptedEngine.Script = .init(),
    journal: ScriptedEngine.Journal = .init(), configuration: Configuration = .init()
  ) {
    self.init(.folder(folder), configuration: configuration) { _, flag, onEvent in
      ScriptedEngine(script, flag, journal, onEvent)
    }
  }
}

import Foundation
import Pipeline
import RealityFoundation
import SceneModel
import SharedCommands

// What `reconstruct` does instead of a run: a dry run, a part of a run, or a run on many machines.

extension PipelineEngine {
  package static func runInstead(
    _ arguments: ReconstructArguments<PipelineArguments>, photos: URL, output: ModelOutput,
    _ reporter: RunReporter
  ) async throws -> Bool {
    if arguments.engine.isDryRun {
      try dryRun(arguments, photos: photos, output: output, reporter)
    } else if case .part(let part) = arguments.engine.part {
      try make(part, arguments, photos: photos, reporter)
    } else if arguments.engine.slurm.isUsed {
      try await ChunkedRun(arguments, photos: photos, output: output).run(reporter)
    } else {
      return false
    }
    return true
  }

  private static func dryRun(
    _ arguments: ReconstructArguments<PipelineArguments>, photos: URL, output: ModelOutput,
    _ reporter: RunReporter
  ) throws {
    let plan = try DryRun(arguments, photos: photos, output: output)
    if reporter.style == .json {
      plan.events.forEach(reporter.event)
    } else {
      plan.lines.forEach(Terminal.shared.result)
    }
    guard plan.faults.isEmpty else {
      throw CommandFailure.run(plan.faults.joined(separator: " "))
    }
  }

  /// Makes a part of the run that a session with the same arguments would make.
  private static func make(
    _ part: RunPart, _ arguments: ReconstructArguments<PipelineArguments>, photos: URL,
    _ reporter: RunReporter
  ) throws {
    let session = try PhotogrammetrySession(
      input: photos, configuration: arguments.sessionConfiguration)
    try arguments.engine.configure(session, photos: photos)
    var configuration = try session.pipelineConfiguration
    // The report is that of the whole run.
    configuration.keepsReportMaterial = false
    var runArguments = arguments.engine.runArguments
    runArguments.report = nil
    let plan = EngineRun.Plan(
      source: .photos(in: photos), stages: part.stages, limits: arguments.detail.limits,
      alignment: part.hasCameras ? .none : .search, access: .parts,
      untilInputEnds: arguments.untilInputEnds)
    let run = try EngineRun(plan, configuration, runArguments, reporter)
    try run.perform(missing: "the part was not made") { pipeline in
      try pipeline.make(
        part, for: plan.limits, in: ModelGeometry(arguments.shape.geometry ?? .init()))
    }
    reporter.event(RunEvent("complete") { $0.seconds = reporter.elapsed })
  }
}

extension RunPart {
  /// The stages that a process runs for the part.
  fileprivate var stages: [PipelineStage] {
    switch self {
    case .inspections, .photos: [.preProcessing]
    case .features, .candidates, .pairs, .matches, .morePairs, .moreMatches:
      [.preProcessing, .imageAlignment]
    case .cameras: [.preProcessing, .imageAlignment, .objectMasking]
    case .views:
      [.preProcessing, .imageAlignment, .objectMasking, .pointCloudGeneration]
    case .tileBase, .surface:
      [
        .preProcessing, .imageAlignment, .objectMasking, .pointCloudGeneration, .meshGeneration,
        .optimization,
      ]
    case .tiles, .tileIndex: [.preProcessing, .imageAlignment, .objectMasking, .optimization]
    }
  }

  /// Whether cameras have been found before.
  fileprivate var hasCameras: Bool {
    switch self {
    case .views, .tileBase, .surface, .tiles, .tileIndex: true
    default: false
    }
  }
}

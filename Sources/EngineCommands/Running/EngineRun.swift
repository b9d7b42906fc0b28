import Formats
import Foundation
import Kernels
import Pipeline
import SharedCommands

/// A run of the pipeline by a command: interrupts, progress, report and failure.
struct EngineRun {
  private let pipeline: ReconstructionPipeline
  private let listener: PipelineListener
  private let reportFile: ReportFile?
  private let plan: Plan
  private let flag: CancellationFlag

  /// The stages and parameters of a command's run.
  struct Plan {
    var source: RunSource
    /// In the order of work.
    var stages: [PipelineStage]
    /// The model; nil if the command makes none.
    var output: URL?
    /// The limits that the first stages work for.
    var limits: DetailSpecification
    /// The limits of models that are made before that of `limits`.
    var coarserModels: [DetailSpecification] = []
    /// How cameras and sparse points are obtained, for the estimate of the remaining time.
    var alignment = StageDurationModel.AlignmentWork.search
    /// The share of the views that the dense stage processes.
    var job: PointCloudGeneration.Share?
    var access = CheckpointAccess.exclusive
    /// Whether the end of standard input stops the run.
    var untilInputEnds = false
    /// Whether details are logged without `--verbose`, too.
    var logsDetails = false
  }

  /// Throws a `CommandFailure` if the report can't be written.
  init(
    _ plan: Plan, _ configuration: PipelineConfiguration, _ arguments: RunArguments,
    _ reporter: RunReporter
  ) throws {
    reportFile = try arguments.reportFile()
    self.plan = plan
    var configuration = configuration
    if reportFile?.isPage == true { configuration.keepsReportMaterial = true }
    flag = CancellationFlag()
    listener = PipelineListener(
      reporter, stages: plan.stages, coarserModels: plan.coarserModels,
      durations: StageDurationModel(
        photos: PhotoTotals(count: plan.source.fileCount), finest: plan.limits,
        threadCount: configuration.threadCount, alignment: plan.alignment,
        denseShare: plan.job.map { 1 / Double($0.count) } ?? 1),
      logsDetails: plan.logsDetails)
    pipeline = ReconstructionPipeline(
      plan.source, configuration: configuration,
      checkpointAccess: plan.access, flag: flag,
      onEvent: listener.receive)
    pipeline.plan(for: plan.coarserModels + [plan.limits])
  }

  /// Calls `work` with the pipeline, and writes the report whether it fails or not. A failure after
  /// an interrupt becomes "Interrupted; " with the `missing` result.
  func perform(missing: String, _ work: (ReconstructionPipeline) throws -> Void) throws {
    let interrupts = InterruptHandler(untilInputEnds: plan.untilInputEnds) { [flag] in
      flag.cancel()
    }
    let outcome = Result { try work(pipeline) }
    listener.finish()
    try writeReport()
    if case .failure(let error) = outcome {
      guard interrupts.wasInterrupted else { throw error }
      throw CommandFailure.interrupted("Interrupted; \(missing).")
    }
  }

  /// Writes the report into the checkpoint directory, and to the file of `--report`.
  private func writeReport() throws {
    try pipeline.writeReport()
    guard let reportFile else { return }
    let material = pipeline.reportMaterial()
    let content = try reportFile.content(
      pipeline.report, material, photos: plan.source.photoFolder,
      output: plan.output)
    try AtomicFile.write(content, to: reportFile.url)
  }
}

extension RunSource {
  /// The files in the folder of the photos: an estimate of the number of photos before they are
  /// read.
  fileprivate var fileCount: Int { (try? PhotoFolder.files(in: photoFolder).count) ?? 0 }
}

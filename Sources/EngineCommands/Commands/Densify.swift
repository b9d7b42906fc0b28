import ArgumentParser
import Foundation
import Kernels
import Pipeline
import SharedCommands

/// Makes a dense point cloud from photos with known cameras.
struct Densify: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "densify",
    abstract: "Make a dense point cloud from photos with known cameras.",
    discussion: DensifyHelp.discussion)

  @Argument(
    help: ArgumentHelp("The folder with the photos.", valueName: "input-folder"),
    completion: .directory)
  var inputFolder: String

  @Argument(
    help: ArgumentHelp("The folder with the cameras; see above.", valueName: "cameras-folder"),
    completion: .directory)
  var camerasFolder: String

  @Argument(
    help: ArgumentHelp("The folder for the results.", valueName: "output"), completion: .directory
  )
  var output: String

  @Option(name: .shortAndLong, help: "Density of the cloud; see the table above.")
  var detail = DetailArgument.medium

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Maximum number of pixels per view, instead of that of the level.", visibility: .hidden))
  var viewPixels: Int?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Omit a step, to measure what it contributes.", valueName: "step", visibility: .hidden))
  var without: [Ablation] = []

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Process only a share of the views; see above.", valueName: "number/count"))
  var job: JobArgument?

  @Flag(
    name: .long,
    help: "The cameras' unit is the meter; the density is then reported in points per cubic meter.")
  var metric = false

  @Flag(name: .long, help: "Ignore the photos' masks; see 'align --help'.")
  var noObjectMasking = false

  @OptionGroup var masking: MaskArguments

  @OptionGroup var runArguments: RunArguments

  @OptionGroup var logging: LoggingOptions

  func validate() throws {
    if let viewPixels, viewPixels < 10_000 {
      throw ValidationError("--view-pixels must be 10000 or more.")
    }
  }

  mutating func run() throws {
    logging.bootstrap()
    let folder = try PhotoFolderArgument(inputFolder).url
    let cameras = try KnownCamerasArgument(camerasFolder, isMetric: metric).cameras
    let target = URL(fileURLWithPath: output, isDirectory: true)
    try ModelOutput.checkWritable(target)
    let plan = EngineRun.Plan(
      source: .photosWithCameras(in: folder, cameras),
      stages: [.preProcessing, .imageAlignment, .pointCloudGeneration], limits: limits,
      alignment: cameras.reconstruction.points.isEmpty ? .triangulation : .none,
      job: job?.share, access: job == nil ? .exclusive : .shared, logsDetails: true)
    let run = try EngineRun(
      plan, try configuration(target), runArguments, RunReporter(logging.style()))
    try run.perform(missing: "no points were written") { pipeline in
      if let share = plan.job {
        try pipeline.makePatches(share, for: plan.limits)
      } else {
        _ = try pipeline.densify(for: plan.limits)
      }
    }
    let result = job == nil ? "dense/points.ply" : "dense/views"
    Terminal.shared.result(target.appendingPathComponent(result).relativePath)
  }
}

extension Densify {
  private func configuration(_ target: URL) throws -> PipelineConfiguration {
    var configuration = PipelineConfiguration()
    configuration.checkpointDirectory = target
    try masking.apply(to: &configuration, areIgnored: noObjectMasking)
    // The cloud of the whole scene: masks restrict it only if they are given.
    configuration.meshGeneration.isolatesObject = false
    runArguments.threading.apply(to: &configuration)
    without.forEach { $0.apply(to: &configuration.pointCloudGeneration) }
    try runArguments.checkOverrides()
    return try configuration.applying(runArguments.set)
  }

  private var limits: DetailSpecification {
    var limits = detail.limits
    if let viewPixels { limits.viewPixels = viewPixels }
    return limits
  }
}

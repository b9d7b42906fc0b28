import ArgumentParser
import Foundation
import Kernels
import Pipeline
import SharedCommands

/// Estimates cameras, poses and sparse points.
struct Align: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "align",
    abstract: "Estimate the cameras and poses of photos without reconstructing a model.",
    discussion: """
      Writes sparse/cameras.txt, images.txt and points3D.txt, COLMAP's text format that programs \
      for neural rendering, stereo and surveying read, and report.json into the folder <output>. \
      If alignment fails, it writes report.json only, with the reason. 'reconstruct' starts with \
      the same alignment.

      EXAMPLES
        photogrammetry-cli align photos/ work/
        photogrammetry-cli align drone/ work/ -o sequential --mapping global

      \(MaskArguments.help)
      \(ScaleArguments.help)
      Exit codes: 0 cameras were written, 1 too few photos could be registered, 2 invalid \
      arguments or paths, 130 interrupted.
      """)

  @Argument(
    help: ArgumentHelp("The folder with the photos.", valueName: "input-folder"),
    completion: .directory)
  var inputFolder: String

  @Argument(
    help: ArgumentHelp("The folder for the results.", valueName: "output"), completion: .directory
  )
  var output: String

  @OptionGroup var alignment: AlignmentArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Structure-from-motion method; 'automatic' chooses one by the photos.",
      valueName: "method"))
  var mapping = MappingMethod.automatic

  @Flag(name: .long, help: "Ignore the photos' masks.")
  var noObjectMasking = false

  @OptionGroup var masking: MaskArguments

  @OptionGroup var runArguments: RunArguments

  @OptionGroup var scale: ScaleArguments

  @OptionGroup var frame: UpArguments

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    let folder = try PhotoFolderArgument(inputFolder).url
    let target = URL(fileURLWithPath: output, isDirectory: true)
    try ModelOutput.checkWritable(target)
    let plan = EngineRun.Plan(
      source: .photos(in: folder), stages: [.preProcessing, .imageAlignment],
      limits: DetailSpecification(.reduced))
    let run = try EngineRun(
      plan, try configuration(photos: folder, target), runArguments, RunReporter(logging.style()))
    try run.perform(missing: "no cameras were written") { _ = try $0.align() }
    Terminal.shared.result(target.appendingPathComponent("sparse").relativePath)
  }
}

extension MappingMethod: ExpressibleByArgument {}

extension Align {
  private func configuration(photos: URL, _ target: URL) throws -> PipelineConfiguration {
    var configuration = PipelineConfiguration()
    alignment.apply(to: &configuration)
    configuration.alignment.mapping.method = mapping
    try masking.apply(to: &configuration, areIgnored: noObjectMasking)
    configuration.checkpointDirectory = target
    try scale.apply(to: &configuration, photos: photos)
    frame.apply(to: &configuration)
    runArguments.threading.apply(to: &configuration)
    try runArguments.checkOverrides()
    return try configuration.applying(runArguments.set)
  }
}

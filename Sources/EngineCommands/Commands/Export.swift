import ArgumentParser
import Formats
import Foundation
import Kernels
import Logging
import Pipeline
import RealityFoundation
import SceneModel
import SharedCommands

/// Makes another model from the checkpoint directory of a run.
struct Export: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "export",
    abstract: "Make a model of another detail level or format from a finished run.",
    discussion: """
      Simplifies and textures the surface in the checkpoint directory of a run, without repeating \
      alignment and dense reconstruction. The same level gives the same model as the run.

      EXAMPLES
        photogrammetry-cli photos/ model.usdz -d medium --checkpoint-directory work/
        photogrammetry-cli export work/ small.usdz -d preview
            Another level.
        photogrammetry-cli export work/ model.glb -d medium
            Another format.
        photogrammetry-cli export work/ model/ -d medium --preview model.png
            A folder with OBJ, MTL, USDA and textures, and a picture.
        photogrammetry-cli export work/ shop.glb -d medium --compress --lod
            Small files for the web: shop.glb, shop-reduced.glb and shop-preview.glb.

      \(DetailArguments.help)
      A level above that of the run gives more triangles and texels, but no more detail than the \
      surface of the run has.

      Exit codes: 0 the model was written, 1 it could not be made, 2 invalid arguments or paths, \
      or no finished run in the folder, 130 interrupted.
      """)

  @Argument(
    help: ArgumentHelp(
      "The folder that was the run's --checkpoint-directory.",
      valueName: "checkpoint-directory"), completion: .directory)
  var checkpointDirectory: String

  @Argument(
    help: ArgumentHelp(
      "The file or folder of the model, as for 'reconstruct'.", valueName: "output"),
    completion: .file())
  var output: String

  @OptionGroup var detail: DetailArguments

  @OptionGroup var shape: ShapeArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      "The folder with the photos, if they were moved since the run.", valueName: "folder"),
    completion: .directory)
  var photos: String?

  @OptionGroup var compression: CompressionArguments

  @OptionGroup var preview: PreviewArguments

  @OptionGroup var viewer: ViewerArguments

  @OptionGroup var runArguments: RunArguments

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    let target = try ModelOutput(output, formats: ModelFormat.files)
    try compression.check(target.format, detail)
    let coarser = try CoarserModel.all(detail, nextTo: target)
    let configuration = try configuration
    let geometry = ModelGeometry(shape.geometry ?? .init())
    let plan = EngineRun.Plan(
      source: .savedRun(try savedRun()), stages: [.preProcessing, .textureMapping, .optimization],
      output: target.url, limits: detail.limits, coarserModels: coarser.map(\.level.limits))
    let page = try viewer.file(of: target, besides: try runArguments.reportFile())
    let reporter = RunReporter(logging.style())
    let run = try EngineRun(plan, configuration, runArguments, reporter)
    try run.perform(missing: "\(coarser.isEmpty ? "no" : "not every") model was written") {
      pipeline in
      for model in coarser {
        try pipeline.writeModel(
          model.level.limits, in: geometry, to: model.output.url, hasPreview: false)
        Terminal.shared.result(model.output.url.relativePath)
      }
      try pipeline.writeModel(plan.limits, in: geometry, to: target.url)
      Terminal.shared.result(target.url.relativePath)
      if let page,
        let content = try page.content(
          pipeline.reportMaterial(), name: target.url.lastPathComponent)
      {
        try AtomicFile.write(content, to: page.url)
        Terminal.shared.result(page.url.relativePath)
      }
    }
    if let file = configuration.previewFile { Terminal.shared.result(file.relativePath) }
    Logger(label: "photogrammetry-cli")
      .info("Done in \(RunProgress.duration(reporter.elapsed)).")
  }
}

extension Export {
  private var configuration: PipelineConfiguration {
    get throws {
      var configuration = PipelineConfiguration()
      try preview.apply(to: &configuration)
      shape.apply(to: &configuration)
      compression.apply(to: &configuration)
      configuration.keepsReportMaterial = viewer.viewer
      runArguments.threading.apply(to: &configuration)
      try runArguments.checkOverrides()
      return try configuration.applying(runArguments.set)
    }
  }

  /// The run in the checkpoint directory; throws a `CommandFailure` if it isn't finished.
  private func savedRun() throws -> SavedRun {
    let folder = try photos.map { try PhotoFolderArgument($0).url }
    do {
      return try SavedRun(
        checkpoint: URL(fileURLWithPath: checkpointDirectory, isDirectory: true), photos: folder)
    } catch let error as SavedRunError {
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
  }
}

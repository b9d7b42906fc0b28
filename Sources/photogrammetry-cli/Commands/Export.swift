#if canImport(Pipeline)
  import ArgumentParser
  import Foundation
  import Kernels
  import Logging
  import Pipeline
  import RealityFoundation
  import SceneModel

  /// Makes another model of what a run left in its checkpoint directory.
  struct Export: ParsableCommand {
    static let configuration = CommandConfiguration(
      commandName: "export",
      abstract: "Make a model of another level or format from a finished run.",
      discussion: """
        Simplifies and textures the surface that a run with --checkpoint-directory has left, without \
        finding cameras and points again. The same level gives the same model as the run.

        EXAMPLES
          photogrammetry-cli photos/ model.usdz -d medium --checkpoint-directory work/
          photogrammetry-cli export work/ small.usdz -d preview
              The same at another level.
          photogrammetry-cli export work/ model.glb -d medium
              In another format.
          photogrammetry-cli export work/ model/ -d medium --preview model.png
              As a folder with OBJ, MTL, USDA and textures, and a picture.

        \(DetailArguments.help)
        A level above that of the run gets more triangles and texels, but no more detail of the \
        surface than the run found.

        Exit codes: 0 the model was written, 1 it could not be made, 2 the command line can't be \
        carried out, or the folder holds no finished run, 130 interrupted.
        """)

    @Argument(
      help: ArgumentHelp(
        "The folder that the run was given as --checkpoint-directory.",
        valueName: "checkpoint-directory"), completion: .directory)
    var checkpointDirectory: String

    @Argument(
      help: ArgumentHelp(
        "A file or folder for the model, as for 'reconstruct'.", valueName: "output"),
      completion: .file())
    var output: String

    @OptionGroup var detail: DetailArguments

    @OptionGroup var shape: ShapeArguments

    @Option(
      name: .long,
      help: ArgumentHelp(
        "The folder with the photos, where they have moved since the run.", valueName: "folder"),
      completion: .directory)
    var photos: String?

    @OptionGroup var preview: PreviewArguments

    @OptionGroup var arguments: RunArguments

    @OptionGroup var logging: LoggingOptions

    mutating func run() throws {
      logging.bootstrap()
      let target = try ModelOutput(output)
      try arguments.checkOutputs()
      var configuration = PipelineConfiguration()
      configuration.previewFile = try preview.file()
      configuration.meshPrimitive = shape.quads ? .quad : .triangle
      if let threads = arguments.threads { configuration.threadCount = threads }
      let specification = detail.budgets
      let geometry = ModelGeometry(shape.geometry ?? .init())
      let saved = try savedRun()
      let flag = CancellationFlag()
      let interrupts = InterruptHandler { flag.cancel() }
      let reporter = RunReporter(logging.style(json: false))
      let listener = PipelineListener(reporter, stages: Self.stages)
      let pipeline = ReconstructionPipeline(
        .savedRun(saved), configuration: configuration, flag: flag, onEvent: listener.take)
      let outcome = Result {
        try pipeline.writeModel(specification, in: geometry, to: target.url)
      }
      listener.finish()
      try arguments.writeReport(of: pipeline)
      if case .failure(let error) = outcome {
        guard interrupts.wasInterrupted else { throw error }
        throw CommandFailure(
          sentence: "Interrupted; no model was written.",
          exitCode: CommandFailure.interruptedCode)
      }
      Terminal.shared.result(target.url.relativePath)
      if let file = configuration.previewFile { Terminal.shared.result(file.relativePath) }
      Logger(label: "photogrammetry-cli")
        .info("Done in \(RunProgress.duration(reporter.elapsed)).")
    }

    /// What the run left; throws a `CommandFailure`.
    private func savedRun() throws -> SavedRun {
      let folder = try photos.map { try PhotoFolderArgument($0).url }
      do {
        return try SavedRun(
          checkpoint: URL(fileURLWithPath: checkpointDirectory, isDirectory: true), photos: folder)
      } catch let error as SavedRunError {
        throw CommandFailure.usage(sentence(for: error))
      }
    }

    /// The stages with their usual shares of the time.
    private static let stages: [PipelineListener.Stage] = [
      .init(.preProcessing, as: .preProcessing, share: 0.1),
      .init(.textureMapping, as: .textureMapping, share: 0.75),
      .init(.optimization, as: .optimization, share: 0.15),
    ]
  }

  extension DetailArguments {
    var budgets: DetailSpecification {
      DetailSpecification(detail.detail, custom: specification)
    }
  }
#endif

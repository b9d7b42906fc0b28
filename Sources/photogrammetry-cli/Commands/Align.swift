#if canImport(Pipeline)
  import ArgumentParser
  import Foundation
  import Kernels
  import Pipeline
  import RealityFoundation
  import SceneModel

  /// Finds cameras, poses and sparse points, and nothing else.
  struct Align: ParsableCommand {
    static let configuration = CommandConfiguration(
      commandName: "align",
      abstract: "Find where photos were taken from, without making a model.",
      discussion: """
        Writes sparse/cameras.txt, images.txt and points3D.txt, the text format of COLMAP that other \
        programs for neural rendering, stereo and surveying read, and report.json, into the folder \
        <output>; where alignment fails, report.json alone, which says why. The same alignment is \
        what 'reconstruct' begins with.

        EXAMPLES
          photogrammetry-cli align photos/ work/
          photogrammetry-cli align drone/ work/ -o sequential --mapping global

        \(EngineArguments.maskHelp)
        \(EngineArguments.scaleHelp)
        Exit codes: 0 cameras were found, 1 too few photos fit together, 2 the command line can't be \
        carried out, 130 interrupted.
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
        "Find the poses photo by photo, all at once, or as suits the photos.",
        valueName: "method"))
    var mapping = MappingMethod.automatic

    @Flag(name: .long, help: "Ignore the photos' masks.")
    var noObjectMasking = false

    @OptionGroup var engine: EngineArguments

    @OptionGroup var logging: LoggingOptions

    mutating func run() throws {
      logging.bootstrap()
      let folder = try PhotoFolderArgument(inputFolder).url
      let target = URL(fileURLWithPath: output, isDirectory: true)
      try ModelOutput.checkWritable(target)
      try engine.checkOutputs()
      let configuration = try configuration(photos: folder, target)
      let flag = CancellationFlag()
      let interrupts = InterruptHandler { flag.cancel() }
      let listener = PipelineListener(
        RunReporter(logging.style(json: false)),
        stages: [
          // Reading and checking takes a twentieth of the time.
          .init(.preProcessing, as: .preProcessing, share: 0.05),
          .init(.imageAlignment, as: .imageAlignment, share: 0.95),
        ])
      let pipeline = ReconstructionPipeline(
        .photos(in: folder), configuration: configuration, flag: flag, onEvent: listener.take)
      let outcome = Result { try pipeline.align() }
      listener.finish()
      try engine.runArguments.writeReport(of: pipeline)
      if case .failure(let error) = outcome {
        guard interrupts.wasInterrupted else { throw error }
        throw CommandFailure(
          sentence: "Interrupted; no cameras were written.",
          exitCode: CommandFailure.interruptedCode)
      }
      Terminal.shared.result(target.appendingPathComponent("sparse").relativePath)
    }
  }

  extension MappingMethod: ExpressibleByArgument {}

  extension Align {
    /// What the pipeline is told.
    private func configuration(photos: URL, _ target: URL) throws -> PipelineConfiguration {
      var configuration = PipelineConfiguration()
      configuration.alignment.ordering = .init(alignment.sampleOrdering.ordering)
      configuration.alignment.features.sensitivity =
        .init(alignment.featureSensitivity.sensitivity)
      configuration.alignment.mapping.method = mapping
      configuration.isObjectMaskingEnabled = !noObjectMasking
      configuration.ingestion.maskFolder = try engine.masking.folder
      configuration.checkpointDirectory = target
      configuration.alignment.worldAlignment.knownDistances = try engine.knownDistances(photos: photos)
      if let threads = engine.threads { configuration.threadCount = threads }
      return configuration
    }
  }
#endif

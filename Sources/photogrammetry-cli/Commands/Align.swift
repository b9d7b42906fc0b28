#if canImport(Pipeline)
  import ArgumentParser
  import Formats
  import Foundation
  import Kernels
  import Logging
  import Pipeline
  import SceneModel
  import Synchronization

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

        \(EngineArguments.scaleHelp)
        Exit codes: 0 cameras were found, 1 too few photos fit together, 2 the command line can't be \
        carried out, 130 interrupted.
        """)

    @Argument(help: ArgumentHelp("The folder with the photos.", valueName: "input-folder"))
    var inputFolder: String

    @Argument(help: ArgumentHelp("The folder for the results.", valueName: "output"))
    var output: String

    @OptionGroup var alignment: AlignmentArguments

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Find the poses photo by photo, all at once, or as suits the photos.",
        valueName: "method"))
    var mapping = MappingMethod.automatic

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
      let listener = AlignmentListener(RunReporter(logging.style(json: false)))
      let pipeline = ReconstructionPipeline(
        folder: folder, configuration: configuration, flag: flag, onEvent: listener.take)
      let outcome = Result { try pipeline.align() }
      listener.finish()
      try writeReport(of: pipeline)
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
    /// Writes the report into the folder for the results, and where it was asked for besides.
    private func writeReport(of pipeline: ReconstructionPipeline) throws {
      try pipeline.writeReport()
      if let report = engine.report {
        try AtomicFile.write(try pipeline.report.encoded(), to: URL(fileURLWithPath: report))
      }
    }

    /// What the pipeline is told.
    private func configuration(photos: URL, _ target: URL) throws -> PipelineConfiguration {
      var configuration = PipelineConfiguration()
      configuration.isSequential = alignment.sampleOrdering == .sequential
      configuration.isHighSensitivity = alignment.featureSensitivity == .high
      configuration.mappingMethod = mapping
      configuration.checkpointDirectory = target
      configuration.knownDistances = try engine.knownDistances(photos: photos)
      if let threads = engine.threads { configuration.threadCount = threads }
      return configuration
    }
  }

  /// Shows the progress of an alignment and logs what happens on the way; any thread may call it.
  private final class AlignmentListener: Sendable {
    private let reporter: Mutex<RunReporter>
    private let logger = Logger(label: "photogrammetry-cli")

    init(_ reporter: RunReporter) { self.reporter = Mutex(reporter) }

    func take(_ event: PipelineEvent) {
      switch event {
      case .progress(let stage, let fraction):
        // Reading and checking takes a twentieth of the time.
        let done = stage == .preProcessing ? 0.05 * fraction : 0.05 + 0.95 * fraction
        let shown: RunStage = stage == .preProcessing ? .preProcessing : .imageAlignment
        reporter.withLock { reporter in
          let elapsed = reporter.elapsed
          let remaining = done > 0.1 ? elapsed / done * (1 - done) : nil
          reporter.update(RunProgress(fraction: done, stage: shown, remaining: remaining))
        }
      case .refused(let photo): logger.warning("\(photo.reason)")
      case .warning(let sentence): logger.warning("\(sentence)")
      default: break
      }
    }

    func finish() { reporter.withLock { $0.finish() } }
  }
#endif

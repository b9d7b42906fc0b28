#if canImport(Pipeline)
  import ArgumentParser
  import Formats
  import Foundation
  import Logging
  import Pipeline
  import RealityFoundation

  /// Makes a model of each of many folders of photos.
  struct Batch: AsyncParsableCommand {
    static let configuration = CommandConfiguration(
      commandName: "batch",
      abstract: "Reconstruct every folder of photos in a folder.",
      discussion: """
        Each folder in <folders> is a dataset: its photos are in itself or in images/, masks as \
        'reconstruct' finds them or in masks/ beside images/, and distances that give the scale, as \
        for its --measurements, in measurements.json. The model of <folders>/chair/ becomes \
        <models>/chair.usdz. What failed is named with the reason, and the \
        rest goes on. The summary is printed, and written to <models>/batch.json and batch.csv after \
        every dataset.

        The same command again makes only what is missing, or whose photos or options have changed. A \
        batch that was interrupted goes on where it was: until a model is done, its finished stages \
        are in <models>/.work/.

        EXAMPLES
          photogrammetry-cli batch sets/ models/
          photogrammetry-cli batch sets/ models/ --format glb -d medium
              In another format, at another level.
          photogrammetry-cli batch sets/ models/ --jobs 4 --previews
              At most four at once; a picture of each model besides.

        JOBS
          Each dataset is worked on by a process of its own. As many run at once as
          there are processors, at most --jobs, and no more than the free memory has
          room for. What failed of a cause that may pass (a run that was killed or
          crashed, too little memory) is tried again at the end, alone.

        EVENTS (with --json, one JSON object a line on stdout, and nothing else)
          began     dataset
          ended     dataset, status (done, skipped, failed, cancelled), photos,
                    registered, triangles, seconds, attempts, path, message
          and those of 'reconstruct' with their dataset. One of these is the last:
          complete, failed, cancelled
                    datasets, done, skipped, failed, cancelled, seconds, message

        \(DetailArguments.help)
        Exit codes: 0 all datasets have their model, 1 some have not, 2 the command line can't be \
        carried out, 130 interrupted.
        """)

    @Argument(
      help: ArgumentHelp(
        "The folder with a folder of photos for each object.", valueName: "folders"),
      completion: .directory)
    var folders: String

    @Argument(
      help: ArgumentHelp("The folder for the models; made if missing.", valueName: "models"),
      completion: .directory)
    var models: String

    @Option(name: .long, help: "What the models are written as.")
    var format = ModelFormat.usdz

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Datasets to work on at once, at most. (default: as many as processors)",
        valueName: "count"))
    var jobs: Int?

    @Option(
      name: .long,
      help: ArgumentHelp(
        "How often to try again what failed of a cause that may pass.", valueName: "count"))
    var retries = 1

    @Flag(name: .long, help: "Leave the finished stages of done datasets in <models>/.work/ too.")
    var keepCheckpoints = false

    @Flag(name: .long, help: "Draw each model from eight sides, into <models>/<name>.png.")
    var previews = false

    @Flag(name: .long, help: "Write the cameras' poses into <models>/<name>.poses.json.")
    var poses = false

    @Flag(name: .long, help: "Write the coloured points into <models>/<name>.points.ply.")
    var pointClouds = false

    @OptionGroup var detail: DetailArguments

    @OptionGroup var alignment: AlignmentArguments

    @Flag(name: .long, help: "Keep the surroundings instead of isolating the object; ignore masks.")
    var noObjectMasking = false

    @OptionGroup var surface: SurfaceArguments

    @OptionGroup var shape: ShapeArguments

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Threads of each job. (default: the processors, shared out)", valueName: "count"))
    var threads: Int?

    @Flag(name: .long, help: "Tell progress and results as JSON, an object a line, on stdout.")
    var json = false

    @OptionGroup var logging: LoggingOptions

    func validate() throws {
      if let jobs, jobs < 1 { throw ValidationError("--jobs must be 1 or more.") }
      if retries < 0 { throw ValidationError("--retries must be 0 or more.") }
      if let threads, threads < 1 || threads > 1024 {
        throw ValidationError("--threads must be from 1 to 1024.")
      }
    }

    mutating func run() async throws {
      logging.bootstrap()
      let reporter = RunReporter(logging.style(json: json))
      do {
        let runner = try makeRunner(reporter.style)
        let interrupts = InterruptHandler { runner.stop() }
        try await runner.run()
        try conclude(runner.summary, wasInterrupted: interrupts.wasInterrupted, reporter)
      } catch let error as Conclusion {
        throw error.failure
      } catch {
        reporter.failed(error)
        throw error
      }
    }
  }

  extension ModelFormat: ExpressibleByArgument {}

  /// A failure that was told already.
  private struct Conclusion: Error {
    var failure: CommandFailure
  }

  extension Batch {
    private func makeRunner(_ style: RunReporter.Style) throws -> BatchRunner {
      let input = try PhotoFolderArgument(folders).url
      let output = URL(fileURLWithPath: models, isDirectory: true)
      try ModelOutput.checkWritable(output)
      guard input.resolvingSymlinksInPath().path != output.resolvingSymlinksInPath().path else {
        throw CommandFailure.usage("The models need a folder of their own; name another.")
      }
      let datasets = try BatchDataset.all(in: input, except: output)
      guard !datasets.isEmpty else {
        throw CommandFailure.usage(
          "\(folders) holds no folders. Name the folder that holds a folder of photos for each "
            + "object; for the photos of one object leave out 'batch'.")
      }
      return BatchRunner(
        datasets, in: try BatchFolder(output, format: format), stamped: modelWords,
        companions: companions, style, options: options)
    }

    private var companions: [BatchCompanion] {
      (previews ? [.preview] : []) + (poses ? [.poses] : []) + (pointClouds ? [.pointCloud] : [])
    }

    /// The options that change models.
    var modelWords: [String] {
      detail.words + alignment.words + surface.words + shape.words
        + (noObjectMasking ? ["--no-object-masking"] : [])
    }

    private func options(openDatasets: Int) -> BatchRunner.Options {
      let plan = BatchPlan(
        datasets: openDatasets, wishedJobs: jobs, wishedThreads: threads,
        processors: ProcessInfo.processInfo.activeProcessorCount,
        memory: Machine.current.availableMemoryBytes,
        memoryOfJob: BatchPlan.memory(for: detail.detail))
      if plan.isLimitedByMemory {
        Logger(label: "photogrammetry-cli").warning(
          "The free memory has room for \(plan.jobs) job\(plan.jobs == 1 ? "" : "s") at once.")
      }
      return BatchRunner.Options(
        plan: plan, retries: retries, keepsCheckpoints: keepCheckpoints,
        arguments: modelWords + (logging.verbose ? ["--verbose"] : []), companions: companions)
    }

    /// Prints the summary; throws unless there are all models.
    private func conclude(
      _ summary: BatchSummary, wasInterrupted: Bool, _ reporter: RunReporter
    ) throws {
      if !json { summary.lines.forEach(Terminal.shared.result) }
      let failed = summary.count(.failed)
      let cancelled = summary.count(.cancelled)
      var failure: CommandFailure?
      if wasInterrupted, cancelled > 0 {
        failure = CommandFailure(
          sentence: "Interrupted; run the same command again to go on.",
          exitCode: CommandFailure.interruptedCode)
      } else if failed + cancelled > 0 {
        failure = .run(
          "\(failed + cancelled) of \(summary.datasets.count) datasets have no model.")
      }
      let event = failure == nil ? "complete" : wasInterrupted ? "cancelled" : "failed"
      reporter.event(
        RunEvent(
          event: event, message: failure?.sentence, seconds: reporter.elapsed,
          datasets: summary.datasets.count, done: summary.count(.done),
          skipped: summary.count(.skipped), failed: failed, cancelled: cancelled))
      if let failure { throw Conclusion(failure: failure) }
    }
  }
#endif

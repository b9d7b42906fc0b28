import ArgumentParser
import Formats
import Foundation
import Logging
import Pipeline
import SharedCommands

/// Makes a model of each of many folders of photos.
struct Batch: AsyncParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "batch",
    abstract: "Reconstruct every folder of photos in a folder.",
    discussion: """
      Each folder in <folders> is a dataset: its photos are directly in it or in images/, masks \
      where 'reconstruct' finds them or in masks/ next to images/, and measured distances, as for \
      --measurements, in measurements.json. The model of <folders>/chair/ is \
      <models>/chair.usdz. A failed dataset does not stop the others. The summary is printed at \
      the end, and written to <models>/batch.json and batch.csv after every dataset.

      Running the same command again makes only models that are missing or whose photos or options \
      have changed. An interrupted batch resumes: until a model is done, its finished stages are \
      kept in <models>/.work/.

      EXAMPLES
        photogrammetry-cli batch sets/ models/
        photogrammetry-cli batch sets/ models/ --format glb -d medium
            Another format and detail level.
        photogrammetry-cli batch sets/ models/ --jobs 4 --previews
            At most four datasets at once, and a picture of each model.
        photogrammetry-cli batch sets/ models/ --reports
            A page about each run, also if it fails: open models/index.html.
        photogrammetry-cli batch sets/ new/ --baseline models/batch.json
            What got worse since an earlier batch, for continuous integration.
        photogrammetry-cli batch sets/ models/ --slurm --partition short
            On the machines of a Slurm cluster.

      JOBS
        Each dataset is processed in a separate process. One job runs per processor,
        but at most --jobs, and no more than the free memory has room for. Transient
        failures (a run that was killed or crashed, too little memory) are retried at
        the end, one at a time.

      EVENTS (with --json: one JSON object per line on stdout, and nothing else)
        began     dataset
        ended     dataset, status (done, skipped, failed, cancelled), photos,
                  registered, triangles, quality, seconds, attempts, path, message
        and the events of 'reconstruct' with their dataset. The last event is one of
        complete, failed, cancelled
                  datasets, done, skipped, failed, cancelled, worse, seconds,
                  message

      \(DetailArguments.help)
      \(SlurmArguments.help)
      Exit codes: 0 all datasets have a model, 1 some have none, 2 invalid arguments or paths, \
      3 with --baseline: all have a model, but some got worse, 130 interrupted.
      """)

  @Argument(
    help: ArgumentHelp(
      "The folder that contains a folder of photos for each object.", valueName: "folders"),
    completion: .directory)
  var folders: String

  @Argument(
    help: ArgumentHelp("The folder for the models; created if missing.", valueName: "models"),
    completion: .directory)
  var models: String

  @Option(name: .long, help: "Format of the models.")
  var format = ModelFormat.usdz

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Maximum number of datasets to process at once. (default: the number of processors)",
      valueName: "count"))
  var jobs: Int?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "How many times to retry a dataset after a transient failure.", valueName: "count"))
  var retries = 1

  @Flag(name: .long, help: "Keep the checkpoints of finished datasets in <models>/.work/.")
  var keepCheckpoints = false

  @Flag(name: .long, help: "Render each model from eight sides, to <models>/<name>.png.")
  var previews = false

  @Flag(
    name: .long,
    help: "Write the report of each run to <models>/<name>.html, and index.html with all of them.")
  var reports = false

  @Flag(name: .long, help: "Write the camera poses to <models>/<name>.poses.json.")
  var poses = false

  @Flag(name: .long, help: "Write the colored points to <models>/<name>.points.ply.")
  var pointClouds = false

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Report which datasets got worse since an earlier batch: fewer photos with a pose, a worse "
        + "verdict, larger errors, missing surface.", valueName: "batch.json"),
    completion: .file(extensions: ["json"]))
  var baseline: String?

  @OptionGroup var detail: DetailArguments

  @OptionGroup var alignment: AlignmentArguments

  @Flag(name: .long, help: "Keep the surroundings instead of isolating the object; ignore masks.")
  var noObjectMasking = false

  @OptionGroup var compression: CompressionArguments

  @OptionGroup var surface: SurfaceArguments

  @OptionGroup var shape: ShapeArguments

  @OptionGroup var frame: UpArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Number of threads per job. (default: processors divided by jobs)", valueName: "count"))
  var threads: Int?

  @OptionGroup var slurm: SlurmArguments

  @Flag(name: .long, help: "Report progress and results as JSON Lines on stdout.")
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
    let failure: CommandFailure?
    do {
      failure = try await slurm.isUsed ? runChunks(reporter) : runHere(reporter)
    } catch {
      let failure = CommandFailure(engineError: error)
      reporter.failed(failure)
      throw failure
    }
    if let failure { throw failure }
  }
}

extension ModelFormat: ExpressibleByArgument {}

extension Batch {
  /// Runs in processes on this machine.
  private func runHere(_ reporter: RunReporter) async throws -> CommandFailure? {
    let baseline = try baseline.map { try BatchBaseline($0) }
    let (datasets, folder) = try datasetsAndFolder()
    let runner = BatchRunner(
      datasets, in: folder, modelArguments: modelArguments, companions: companions,
      reporter.style, options: options)
    let interrupts = InterruptHandler { runner.stop() }
    try await runner.run()
    return BatchConclusion(
      summary: runner.summary, baseline: baseline,
      models: URL(fileURLWithPath: models, isDirectory: true),
      wasInterrupted: interrupts.wasInterrupted
    ).report(reporter)
  }

  /// Checks all paths; throws a `CommandFailure`.
  func datasetsAndFolder() throws -> ([BatchDataset], BatchFolder) {
    let input = try PhotoFolderArgument(folders).url
    let output = URL(fileURLWithPath: models, isDirectory: true)
    try ModelOutput.checkWritable(output)
    guard input.resolvingSymlinksInPath().path != output.resolvingSymlinksInPath().path else {
      throw CommandFailure.usage(
        "\(models) is the folder of the photos. Name another folder for the models.")
    }
    try compression.check(format, detail)
    guard format != .folder || !detail.lod else {
      throw CommandFailure.usage(
        "--lod writes several files per dataset. Choose a file format with --format, or omit --lod."
      )
    }
    let datasets = try BatchDataset.all(in: input, except: output)
    guard !datasets.isEmpty else {
      throw CommandFailure.usage(
        "\(folders) holds no folders. Name the folder that holds a folder of photos for each "
          + "object; to reconstruct a single object omit 'batch'.")
    }
    try checkNames(of: datasets)
    return (
      datasets, try BatchFolder(output, format: format, coarserLevels: detail.coarserLevels)
    )
  }

  /// Throws a `CommandFailure` if a model of a dataset has the name of another dataset's.
  private func checkNames(of datasets: [BatchDataset]) throws {
    let names = Set(datasets.map(\.name))
    guard !reports || !names.contains("index") else {
      throw CommandFailure.usage(
        "With --reports, the report of the dataset index would have the name of the list of all "
          + "reports. Rename the dataset.")
    }
    for name in datasets.map(\.name) {
      for level in detail.coarserLevels where names.contains("\(name)-\(level.rawValue)") {
        throw CommandFailure.usage(
          "With --lod, the datasets \(name) and \(name)-\(level.rawValue) would write the same "
            + "file. Rename one of them, or omit --lod.")
      }
    }
  }

  var companions: [BatchCompanion] {
    (previews ? [.preview] : []) + (reports ? [.report] : []) + (poses ? [.poses] : [])
      + (pointClouds ? [.pointCloud] : [])
  }

  /// The options that affect models, as arguments of `reconstruct`.
  var modelArguments: [String] {
    detail.arguments + compression.arguments + alignment.arguments + surface.arguments
      + shape.arguments
      + frame.arguments
      + (noObjectMasking ? ["--no-object-masking"] : [])
  }

  private func options(openDatasets: Int) -> BatchRunner.Options {
    let plan = BatchPlan(
      datasets: openDatasets, requestedJobs: jobs, requestedThreads: threads,
      processors: ProcessorShare.current.threads,
      memory: Machine.current.availableMemoryBytes,
      memoryOfJob: detail.detail.expectedMemoryBytes)
    if plan.isLimitedByMemory {
      Logger(label: "photogrammetry-cli").warning(
        "The free memory has room for \(plan.jobs) job\(plan.jobs == 1 ? "" : "s") at once.")
    }
    return BatchRunner.Options(
      plan: plan, retries: retries, keepsCheckpoints: keepCheckpoints,
      arguments: modelArguments + (logging.verbose ? ["--verbose"] : []), companions: companions)
  }
}

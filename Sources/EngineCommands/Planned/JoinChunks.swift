import ArgumentParser
import Foundation
import Logging
import Pipeline
import SharedCommands

/// Checks the chunks of a plan and completes the work.
struct JoinChunks: AsyncParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "join",
    abstract: "Check the chunks of a plan, and complete the work.",
    discussion: """
      Reads all files that the chunks made and compares them with what was recorded when they were \
      made: the file of a machine that died may be incomplete. Damaged and missing chunks are \
      named. If none is missing, or if the rest is of use without them, writes what belongs to all \
      of them: for a batch batch.json, batch.csv and index.html next to the models.

      EXAMPLES
        photogrammetry-cli join plan/
            Names what is missing.
        photogrammetry-cli join plan/ --jobs 4
            Makes what is missing in processes on this machine, four at a time.
        photogrammetry-cli join plan/ --slurm
            Submits what is missing to Slurm, as the command that made the plan does.

      Exit codes: 0 all is done, 1 chunks are missing or have failed, 2 invalid arguments or \
      paths, 3 a batch got worse than its baseline, 130 interrupted.
      """)

  @Argument(
    help: ArgumentHelp("The folder of the plan.", valueName: "plan"), completion: .directory)
  var plan: String

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Make what is missing on this machine, this number at a time.", valueName: "count"))
  var jobs: Int?

  @Flag(name: .long, help: "Submit what is missing to Slurm, and exit.")
  var slurm = false

  @Option(
    name: .long,
    help: ArgumentHelp(
      "With --jobs: how many times to make a chunk again after a transient failure.",
      valueName: "count"))
  var retries = 1

  @Flag(name: .long, help: "Report progress and results as JSON Lines on stdout.")
  var json = false

  @OptionGroup var logging: LoggingOptions

  func validate() throws {
    if let jobs, jobs < 1 { throw ValidationError("--jobs must be 1 or more.") }
    if retries < 0 { throw ValidationError("--retries must be 0 or more.") }
    if slurm, jobs != nil { throw ValidationError("--jobs and --slurm are mutually exclusive.") }
  }

  mutating func run() async throws {
    logging.bootstrap()
    let reporter = RunReporter(logging.style(json: json))
    let failure: CommandFailure?
    do {
      failure = try await join(reporter)
    } catch {
      let failure = CommandFailure(error)
      reporter.failed(failure)
      throw failure
    }
    if let failure { throw failure }
  }

  /// Makes what is missing if asked to, checks all, and reports the end. Returns a failure that has
  /// been reported.
  private func join(_ reporter: RunReporter) async throws -> CommandFailure? {
    let folder = try PlanFolder(reading: URL(fileURLWithPath: plan, isDirectory: true))
    if slurm {
      guard try submit(folder) else { return nil }
    } else if let jobs {
      try await LocalChunks(folder, jobs: jobs, retries: retries, reporter.style).run()
    }
    let damaged = folder.forgetDamaged()
    if !damaged.isEmpty {
      Logger(label: "photogrammetry-cli").warning(
        "Files of \(damaged.count) chunks are missing or damaged: they have to be made again.")
    }
    return try folder.report(reporter)
  }

  /// Submits what is next to Slurm; returns whether nothing more can be made.
  private func submit(_ folder: PlanFolder) throws -> Bool {
    let run = try SlurmRun(folder)
    switch try run.advance() {
    case .submitted: return false
    case .waiting:
      let jobs = Set(run.active(try run.jobs()).values.map(\.id))
      if !jobs.isEmpty { try run.submitFollowUp(after: jobs.sorted()) }
      return false
    case .ended: return true
    }
  }
}

import ArgumentParser
import Foundation
import SharedCommands

/// Shows how far a plan on Slurm is.
struct WatchPlan: AsyncParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "watch",
    abstract: "Show the progress of a plan on Slurm.",
    discussion: """
      Shows the same as the command that submitted the plan, from any terminal, and ends when \
      nothing more can be made. Ctrl-C ends the display, a second one within five seconds cancels \
      the jobs.

      EXAMPLES
        photogrammetry-cli watch models/.work/.plan
            The progress of 'batch sets/ models/ --slurm'.

      Exit codes: 0 all is done, 1 chunks have failed, 2 invalid arguments or paths, \
      130 interrupted.
      """)

  @Argument(
    help: ArgumentHelp("The folder of the plan.", valueName: "plan"), completion: .directory)
  var plan: String

  @Flag(name: .long, help: "Report progress and results as JSON Lines on stdout.")
  var json = false

  @OptionGroup var logging: LoggingOptions

  mutating func run() async throws {
    logging.bootstrap()
    let reporter = RunReporter(logging.style(json: json))
    let failure: CommandFailure?
    do {
      let folder = try PlanFolder(reading: URL(fileURLWithPath: plan, isDirectory: true))
      _ = try await SlurmWatch(run: SlurmRun(folder), style: reporter.style).follow()
      failure = try folder.report(reporter)
    } catch {
      let failure = CommandFailure(error)
      reporter.failed(failure)
      throw failure
    }
    if let failure { throw failure }
  }
}

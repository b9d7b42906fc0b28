import ArgumentParser
import Foundation
import Pipeline
import SharedCommands

/// Options of every run: threads and the report.
struct RunArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      """
      Write a report of the run, also if it fails: a page for a browser (.html), or all figures as \
      JSON (.json).
      """, valueName: "file"),
    completion: .file(extensions: ["html", "json"]))
  var report: String?

  @OptionGroup var threading: ThreadArguments

  @Option(
    name: .long,
    help: ArgumentHelp(
      """
      Change an option of the method, to measure what it does: one of those under 'configuration' \
      in report.json, such as alignment.refinement.adjustment.huberWidth=2.
      """, valueName: "option=value"))
  var set: [OptionOverride] = []

  /// The file of the report; throws a `CommandFailure` if it can't be written.
  func reportFile() throws -> ReportFile? { try report.map(ReportFile.init) }

  /// Throws a `CommandFailure` if an option does not exist or has another kind of value.
  func checkOverrides() throws {
    do {
      _ = try PipelineConfiguration().applying(set)
    } catch {
      throw CommandFailure.usage("--set: \(CommandFailure(error).sentence)")
    }
  }
}

extension OptionOverride: ExpressibleByArgument {
  /// Parses `path=value`.
  public init?(argument: String) { self.init(argument) }
}

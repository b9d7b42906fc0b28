import ArgumentParser
import Foundation
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

  /// The file of the report; throws a `CommandFailure` if it can't be written.
  func reportFile() throws -> ReportFile? { try report.map(ReportFile.init) }
}

import ArgumentParser
import Foundation
import SharedCommands

/// Options of every run: threads and the report.
struct RunArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      "Write a report of all stages and photos as JSON.", valueName: "file.json"),
    completion: .file(extensions: ["json"]))
  var report: String?

  @OptionGroup var threading: ThreadArguments

  /// The file of the report; throws a `CommandFailure` if it can't be written.
  func reportFile() throws -> URL? {
    let url = report.map { URL(fileURLWithPath: $0, isDirectory: false) }
    if let url { try ModelOutput.checkWritable(url) }
    return url
  }
}

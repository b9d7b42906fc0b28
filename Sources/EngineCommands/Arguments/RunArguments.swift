import ArgumentParser
import Formats
import Foundation
import Pipeline
import SharedCommands

/// The number of threads.
struct ThreadArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      "Number of threads; does not affect the result. (default: all processors)",
      valueName: "count"))
  var threads: Int?

  func validate() throws {
    if let threads, threads < 1 || threads > 1024 {
      throw ValidationError("--threads must be from 1 to 1024.")
    }
  }

  /// The number of threads to use.
  var threadCount: Int { threads ?? ProcessInfo.processInfo.activeProcessorCount }
}

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

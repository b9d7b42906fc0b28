import ArgumentParser
import Evaluation
import Foundation

/// The form of an evaluation's results.
struct EvaluationOutput: ParsableArguments {
  @Flag(name: .long, help: "Print one JSON object instead of a table.")
  var json = false

  @Flag(name: .long, help: "Print a Markdown table.")
  var markdown = false

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Write a page that shows the distances to the reference on the surface.",
      valueName: "page.html"),
    completion: .file(extensions: ["html"]))
  var page: String?

  func validate() throws {
    if json, markdown { throw ValidationError("Choose --json or --markdown.") }
  }

  func text(_ report: EvaluationReport) throws -> String {
    if json {
      let encoder = JSONEncoder()
      encoder.outputFormatting = [.prettyPrinted, .sortedKeys]
      return String(decoding: try encoder.encode(report), as: UTF8.self)
    }
    let table = EvaluationTable(report)
    return markdown ? table.markdown : table.text
  }
}

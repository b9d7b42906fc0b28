import Formats
import Foundation
import SharedCommands

/// The summary of a batch as files next to the models.
struct BatchFiles: Sendable {
  /// The folder of the models.
  let url: URL

  /// Entries of earlier batches by name; empty if batch.json is missing or can't be parsed.
  func earlierEntries() -> [String: BatchEntry] {
    guard let data = FileManager.default.contents(atPath: summaryFile.path),
      let summary = try? JSONDecoder().decode(BatchSummary.self, from: data)
    else { return [:] }
    return Dictionary(summary.datasets.map { ($0.name, $0) }) { first, _ in first }
  }

  /// Writes batch.csv and batch.json, and the page that lists the reports if there are any.
  func write(_ summary: BatchSummary, hasReports: Bool) throws {
    try AtomicFile.write(Data(summary.csv.utf8), to: url.appendingPathComponent("batch.csv"))
    try AtomicFile.write(try summary.json(), to: summaryFile)
    guard hasReports else { return }
    try AtomicFile.write(
      summary.index(in: url).encoded, to: url.appendingPathComponent("index.html"))
  }

  private var summaryFile: URL { url.appendingPathComponent("batch.json") }
}

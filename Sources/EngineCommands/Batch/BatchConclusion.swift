import Foundation
import SharedCommands

/// The end of a batch: its summary for the user, and whether it failed.
struct BatchConclusion {
  let summary: BatchSummary
  let baseline: BatchBaseline?
  /// The folder of the models.
  let models: URL
  var wasInterrupted = false

  /// Prints the summary; returns a failure unless all datasets have a model.
  func report(_ reporter: RunReporter) -> CommandFailure? {
    let regressions = baseline?.regressions(in: summary)
    if reporter.style != .json {
      summary.lines.forEach(Terminal.shared.result)
      regressions?.map(\.sentence).forEach(Terminal.shared.result)
      if regressions?.isEmpty == true { Terminal.shared.result("Nothing got worse.") }
    }
    let failure = failure(worse: regressions?.map(\.sentence) ?? [])
    reporter.event(
      RunEvent(failure == nil ? "complete" : wasInterrupted ? "cancelled" : "failed") { event in
        event.message = failure?.sentence
        event.seconds = reporter.elapsed
        (event.datasets, event.done) = (summary.datasets.count, summary.count(.done))
        (event.skipped, event.failed) = (summary.count(.skipped), summary.count(.failed))
        (event.cancelled, event.worse) = (summary.count(.cancelled), regressions?.count)
      })
    return failure
  }

  private func failure(worse: [String]) -> CommandFailure? {
    let missing = summary.count(.failed) + summary.count(.cancelled)
    if wasInterrupted, summary.count(.cancelled) > 0 {
      return .interrupted(ChildResult.resumeHint)
    }
    if missing > 0 {
      let reasons = models.appendingPathComponent("batch.csv").relativePath
      return .run(
        "\(missing) of \(summary.datasets.count) datasets have no model. The reasons are in "
          + "\(reasons).")
    }
    return worse.isEmpty ? nil : .regression(worse.joined(separator: " "))
  }
}

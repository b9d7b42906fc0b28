import Foundation
import Logging
import SharedCommands

extension PlanFolder {
  /// Prints what makes the chunks of a plan that was only written.
  func describe() {
    let path = url.relativePath
    let stages = plan.stages.map { "\($0.name) (\($0.chunks.count))" }
    Terminal.shared.result(path)
    Logger(label: "photogrammetry-cli").info(
      """
      The plan has \(plan.count) chunk\(plan.count == 1 ? "" : "s"): \
      \(stages.joined(separator: ", ")). 'photogrammetry-cli chunk \(path) \
      \(plan.stages.first?.name ?? "") 1' makes the first; 'photogrammetry-cli join \(path)' \
      checks them and completes the work, with --jobs it makes what is missing.
      """)
  }

  /// Reports the warnings and the files of the results. Throws a `CommandFailure` if a chunk is
  /// missing: the reason why the first of them failed.
  func conclude(_ reporter: RunReporter) throws {
    guard let first = missing.first else { return reportResults(reporter) }
    guard let status = status(of: first), let error = status.error else {
      let names = missing.prefix(5).map(\.description).joined(separator: ", ")
      throw CommandFailure.run(
        "\(missing.count) of \(plan.count) chunks are missing: \(names)"
          + "\(missing.count > 5 ? " …" : ""). Make them with 'photogrammetry-cli join "
          + "\(url.relativePath) --jobs 1'.")
    }
    throw CommandFailure.run(
      "\(plan[first]?.name ?? "\(first)"): \(error) The log is \(log(of: first).relativePath).",
      isTransient: status.isTransient)
  }

  private func reportResults(_ reporter: RunReporter) {
    let statuses = plan.results.compactMap(status)
    let logger = Logger(label: "photogrammetry-cli")
    for warning in statuses.flatMap(\.warnings) { logger.warning("\(warning)") }
    for event in statuses.flatMap(\.written) {
      if let kind = event.kind, let path = event.path { reporter.wrote(kind, path) }
    }
    // The first is that of the model.
    var event = statuses.first?.result ?? RunEvent("complete")
    event.seconds = reporter.elapsed
    reporter.event(event)
  }
}

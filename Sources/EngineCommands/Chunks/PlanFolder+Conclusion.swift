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

  /// Prints the warnings and the files of the last stage. Returns a failure if a chunk is missing:
  /// the reason why the first of them failed.
  func conclude(_ reporter: RunReporter) -> CommandFailure? {
    guard let first = missing.first else {
      reportLastStage(reporter)
      return nil
    }
    let failure: CommandFailure
    if let status = status(of: first), let error = status.error {
      failure = .run(
        "\(plan[first]?.name ?? "\(first)"): \(error) The log is \(log(of: first).relativePath).",
        isTransient: status.isTransient)
    } else {
      let names = missing.prefix(5).map(\.description).joined(separator: ", ")
      failure = .run(
        "\(missing.count) of \(plan.count) chunks are missing: \(names)"
          + "\(missing.count > 5 ? " …" : ""). Make them with 'photogrammetry-cli join "
          + "\(url.relativePath) --jobs 1'.")
    }
    reporter.failed(failure)
    return failure
  }
  private func reportLastStage(_ reporter: RunReporter) {
    guard let stage = plan.stages.last else { return }
    let statuses = stage.ids.compactMap(status)
    let logger = Logger(label: "photogrammetry-cli")
    for warning in statuses.flatMap(\.warnings) { logger.warning("\(warning)") }
    for path in stage.chunks.flatMap(\.writes) {
      reporter.wrote("model", URL(fileURLWithPath: path).relativePath)
    }
    var event = statuses.last?.result ?? RunEvent("complete")
    event.seconds = reporter.elapsed
    reporter.event(event)
  }
}

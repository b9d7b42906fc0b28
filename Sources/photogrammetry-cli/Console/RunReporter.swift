import Foundation
import Synchronization

/// Tells how a run goes, in the way that suits who listens.
struct RunReporter {
  enum Style: Equatable {
    /// A bar that moves, on a terminal.
    case bar
    /// A line now and then, for log files.
    case lines
    /// One JSON object a line on stdout, for programs.
    case json
    /// Nothing.
    case quiet
  }

  let style: Style
  private var shown = RunProgress()
  private var shownAt = Date.distantPast
  private let start = Date()

  init(_ style: Style) {
    self.style = style
    ConsoleLogHandler.tellsPrograms.store(style == .json, ordering: .relaxed)
  }

  /// Seconds since the run began.
  var elapsed: Double { Date().timeIntervalSince(start) }

  mutating func update(_ progress: RunProgress) {
    switch style {
    case .quiet: return
    case .bar:
      guard isDue(progress, seconds: 0.1) else { return }
      Terminal.shared.show(status: progress.bar(width: Terminal.shared.width))
    case .lines:
      let isNewTenth = Int(progress.fraction * 10) > Int(shown.fraction * 10)
      guard progress.stage != shown.stage || (isNewTenth && isDue(progress, seconds: 1)) else {
        return
      }
      Terminal.shared.message(progress.text)
    case .json:
      guard isDue(progress, seconds: 0.25), progress != shown else { return }
      RunEvent.progress(progress).write()
    }
    (shown, shownAt) = (progress, Date())
  }

  /// A new stage is always worth telling, everything else at intervals.
  private func isDue(_ progress: RunProgress, seconds: Double) -> Bool {
    progress.stage != shown.stage || Date().timeIntervalSince(shownAt) >= seconds
  }

  /// Takes the bar away.
  func finish() {
    if style == .bar { Terminal.shared.show(status: "") }
  }

  /// Tells programs about something that happened; people read the log.
  func event(_ event: RunEvent) {
    if style == .json { event.write() }
  }

  /// Tells programs why a run ends without its result; people are told by the command's last line.
  func failed(_ error: any Error) {
    let failure = error as? CommandFailure
    let isInterrupted = failure?.exitCode == CommandFailure.interruptedCode
    event(
      RunEvent(
        event: isInterrupted ? "cancelled" : "failed", message: sentence(for: error),
        mayPass: isInterrupted ? nil : failure?.mayPass ?? mayPass(error), seconds: elapsed))
  }

  /// Tells that `path` was written.
  func wrote(_ kind: String, _ path: String) {
    if style == .json {
      RunEvent(event: "written", kind: kind, path: path).write()
    } else {
      Terminal.shared.result(path)
    }
  }
}

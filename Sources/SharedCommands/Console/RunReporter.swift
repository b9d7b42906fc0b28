import Foundation
import Synchronization

/// Reports the progress and the results of a run in one of several styles.
package struct RunReporter: Sendable {
  /// How progress is shown.
  package enum Style: Equatable, Sendable {
    /// A progress bar on a terminal.
    case bar
    /// A line per stage and per tenth of the run, for log files.
    case lines
    /// JSON Lines on stdout, for programs.
    case json
    /// No progress.
    case quiet
  }

  /// How progress is shown.
  package let style: Style
  private var shown = RunProgress()
  private var shownAt = Date.distantPast
  private let start = Date()

  /// Begins to measure the time; in the style `json`, warnings become events, too.
  package init(_ style: Style) {
    self.style = style
    ConsoleLogHandler.writesWarningEvents.store(style == .json, ordering: .relaxed)
  }

  /// Seconds since the run began.
  package var elapsed: Double { Date().timeIntervalSince(start) }

  /// Shows `progress`, at most every 0.1 s (bar), 0.25 s (JSON) or 1 s (lines) within a stage.
  package mutating func update(_ progress: RunProgress) {
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

  /// A new stage is due immediately, everything else at intervals.
  private func isDue(_ progress: RunProgress, seconds: Double) -> Bool {
    progress.stage != shown.stage || Date().timeIntervalSince(shownAt) >= seconds
  }

  /// Removes the progress bar.
  package func finish() {
    if style == .bar { Terminal.shared.show(status: "") }
  }

  /// Writes an event if the style is JSON; the log has the same for other styles.
  package func event(_ event: RunEvent) {
    if style == .json { event.write() }
  }

  /// Writes the last event of a run without its result. In other styles the command prints the
  /// failure as its last line.
  package func failed(_ failure: CommandFailure) {
    event(
      RunEvent(failure.isInterrupt ? "cancelled" : "failed") {
        $0.message = failure.sentence
        $0.isTransient = failure.isInterrupt ? nil : failure.isTransient
        $0.seconds = elapsed
      })
  }

  /// Reports that the file or folder `path` was written.
  package func wrote(_ kind: String, _ path: String) {
    if style == .json {
      RunEvent("written") { ($0.kind, $0.path) = (kind, path) }.write()
    } else {
      Terminal.shared.result(path)
    }
  }
}

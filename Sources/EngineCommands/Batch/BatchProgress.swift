import Foundation
import Logging
import SceneModel
import SharedCommands

/// Reports the progress of a batch; safe to call from any thread.
final class BatchProgress: Sendable {
  private struct State {
    var ended = 0
    var running: [(name: String, fraction: Double)] = []
    var shownAt = Date.distantPast
  }

  private let style: RunReporter.Style
  /// Number of datasets to process.
  private let count: Int
  private let state = Locked(State())
  private let logger = Logger(label: "photogrammetry-cli")

  init(_ style: RunReporter.Style, count: Int) {
    (self.style, self.count) = (style, count)
  }

  /// Reports that the run of a dataset begins.
  func began(_ name: String) {
    switch style {
    case .json: RunEvent("began") { $0.dataset = name }.write()
    case .lines: logger.info("\(name) …")
    case .bar, .quiet: break
    }
    show { $0.running.append((name, 0)) }
  }

  /// Forwards an event of a dataset's run.
  func forward(_ event: RunEvent, of name: String) {
    if style == .json, !["complete", "failed", "cancelled"].contains(event.event) {
      var event = event
      event.dataset = name
      event.write()
    }
    guard let fraction = event.fraction else { return }
    show { state in
      if let index = state.running.firstIndex(where: { $0.name == name }) {
        state.running[index].fraction = fraction
      }
    }
  }

  /// Reports the state of a dataset at the end of an attempt; its model is at `path`.
  func ended(_ entry: BatchEntry, path: String?) {
    show(now: true) { state in
      state.running.removeAll { $0.name == entry.name }
      if entry.status != .skipped { state.ended += 1 }
    }
    if style == .json {
      RunEvent("ended") { event in
        event.dataset = entry.name
        event.path = entry.status == .done ? path : nil
        event.message = entry.error
        (event.status, event.attempts) = (entry.status, entry.attempts)
        (event.seconds, event.photos) = (entry.seconds, entry.photos)
        (event.registered, event.triangles) = (entry.registered, entry.triangles)
        event.quality = entry.quality
      }.write()
    } else if entry.status == .failed {
      logger.warning("\(entry.name) failed: \(entry.error ?? "")")
    } else if entry.status == .done {
      logger.info("\(entry.name) is done in \(RunProgress.duration(entry.seconds)).")
    }
  }

  /// Removes the progress bar.
  func finish() {
    if style == .bar { Terminal.shared.show(status: "") }
  }

  private func show(now: Bool = false, _ change: (inout State) -> Void) {
    let line: String? = state.withLock { state in
      change(&state)
      guard style == .bar, now || Date().timeIntervalSince(state.shownAt) > 0.1 else {
        return nil
      }
      state.shownAt = Date()
      let done = Double(state.ended) + state.running.reduce(0) { $0 + $1.fraction }
      let names = state.running.map { "\($0.name) \(Int($0.fraction * 100)) %" }
      let bar = RunProgress(fraction: done / Double(max(1, count))).bar(width: 200)
      let text = "\(bar)  \(state.ended) of \(count)  \(names.joined(separator: ", "))"
      return String(text.prefix(max(0, Terminal.shared.width - 1)))
    }
    if let line { Terminal.shared.show(status: line) }
  }
}

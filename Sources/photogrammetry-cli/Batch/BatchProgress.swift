#if canImport(Pipeline)
  import Foundation
  import Logging
  import SceneModel

  /// Tells how a batch goes; any thread may call it.
  final class BatchProgress: Sendable {
    private struct State {
      var ended = 0
      var running: [(name: String, fraction: Double)] = []
      var shownAt = Date.distantPast
    }

    private let style: RunReporter.Style
    /// Datasets to be worked on.
    private let count: Int
    private let state = Locked(State())
    private let logger = Logger(label: "photogrammetry-cli")

    init(_ style: RunReporter.Style, count: Int) {
      (self.style, self.count) = (style, count)
    }

    func began(_ name: String) {
      switch style {
      case .json: RunEvent(event: "began", dataset: name).write()
      case .lines: logger.info("\(name) …")
      case .bar, .quiet: break
      }
      show { $0.running.append((name, 0)) }
    }

    /// Hands on what the run of a dataset tells.
    func take(_ event: RunEvent, of name: String) {
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

    /// Tells what became of a dataset, whose model is at `path`.
    func ended(_ entry: BatchEntry, path: String?) {
      show(now: true) { state in
        state.running.removeAll { $0.name == entry.name }
        if entry.status != .skipped { state.ended += 1 }
      }
      if style == .json {
        RunEvent(
          event: "ended", dataset: entry.name, path: entry.status == .done ? path : nil,
          message: entry.error, seconds: entry.seconds, photos: entry.photos,
          registered: entry.registered, triangles: entry.triangles, status: entry.status,
          attempts: entry.attempts
        ).write()
      } else if entry.status == .failed {
        logger.warning("\(entry.name) failed: \(entry.error ?? "")")
      } else if entry.status == .done {
        logger.info("\(entry.name) is done in \(RunProgress.duration(entry.seconds)).")
      }
    }

    /// Takes the bar away.
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
#endif

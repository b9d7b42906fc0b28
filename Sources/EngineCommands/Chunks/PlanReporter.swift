import Foundation
import Logging
import SharedCommands

/// Reports how far a plan is, and each chunk that ends.
struct PlanReporter {
  /// Least time between two lines in a log file, in seconds. Chosen.
  private static let lineInterval = 60.0

  let folder: PlanFolder
  let style: RunReporter.Style
  private var known: [ChunkID: ChunkStatus] = [:]
  private var failures: [ChunkID: ChunkStatus] = [:]
  private var shown: (text: String, at: Double) = ("", -.infinity)
  private let logger = Logger(label: "photogrammetry-cli")

  /// What is done already is not reported.
  init(_ folder: PlanFolder, _ style: RunReporter.Style) {
    (self.folder, self.style) = (folder, style)
    for id in folder.plan.stages.flatMap(\.ids) {
      if let done = folder.doneStatus(of: id) { known[id] = done }
      if let status = folder.status(of: id), status.status == .failed { failures[id] = status }
    }
  }

  /// Reports what has changed; `running` are the chunks in jobs that run, `note` is added to the
  /// progress.
  mutating func update(running: Set<ChunkID>, note: String = "") {
    let before = known
    let progress = PlanProgress(folder, known: &known, running: running)
    for (id, status) in known.sorted(by: { "\($0.key)" < "\($1.key)" }) where before[id] == nil {
      ended(id, status)
    }
    for id in folder.plan.stages.flatMap(\.ids) where known[id] == nil {
      guard let status = folder.status(of: id), status.status == .failed,
        failures[id] != status
      else { continue }
      failures[id] = status
      ended(id, status)
    }
    show(progress, note)
  }

  /// Removes the progress bar.
  func finish() {
    if style == .bar { Terminal.shared.show(status: "") }
  }

  private func ended(_ id: ChunkID, _ status: ChunkStatus) {
    let name = folder.plan[id]?.name ?? "\(id)"
    if style == .json {
      RunEvent("ended") { event in
        (event.dataset, event.status, event.message) = (name, status.status, status.error)
        (event.seconds, event.attempts) = (status.seconds, status.attempts)
      }.write()
    } else if status.status == .done {
      logger.info("\(name) is done in \(RunProgress.duration(status.seconds)) on \(status.node).")
    } else {
      let reason = status.error ?? ""
      logger.warning(
        "\(name) failed on \(status.node): \(reason) The log is \(folder.log(of: id).path).")
    }
  }

  private mutating func show(_ progress: PlanProgress, _ note: String) {
    let text = progress.text + (note.isEmpty ? "" : "; \(note)")
    let now = ProcessInfo.processInfo.systemUptime
    switch style {
    case .quiet: return
    case .bar:
      Terminal.shared.show(status: progress.bar(width: Terminal.shared.width, note))
    case .lines:
      guard text != shown.text, now - shown.at >= Self.lineInterval else { return }
      Terminal.shared.message(text)
    case .json:
      guard text != shown.text || now - shown.at >= 1 else { return }
      RunEvent("progress") {
        ($0.fraction, $0.remainingSeconds) = (progress.fraction, progress.remaining)
      }.write()
    }
    shown = (text, now)
  }
}

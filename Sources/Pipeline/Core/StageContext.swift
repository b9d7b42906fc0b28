import Kernels
import SceneModel

/// What a stage needs besides its input: threads, progress, cancellation and a place for its report.
package struct StageContext: Sendable {
  package let control: KernelControl
  package let notes: StageNotes

  package init(control: KernelControl = KernelControl(), notes: StageNotes = StageNotes()) {
    self.control = control
    self.notes = notes
  }

  /// Reports that unit `index` of `count` begins; throws `CancellationError` when the run stops.
  package func step(_ index: Int, of count: Int) throws {
    try control.step(Double(index) / Double(max(1, count)))
  }

  /// The context of a part of the stage that runs from `start` to `end` of its progress.
  package func part(from start: Double, to end: Double) -> StageContext {
    StageContext(control: control.part(from: start, to: end), notes: notes)
  }
}

/// Figures and warnings that a stage leaves for `report.json`.
package final class StageNotes: Sendable {
  private struct State {
    var counts: [String: Double] = [:]
    var warnings: [String] = []
    var details: [String] = []
  }

  private let state = Locked(State())

  package init() {}

  /// Records a figure, for instance `points` or `meanReprojectionError`.
  package func record(_ name: String, _ value: Double) {
    state.withLock { $0.counts[name] = value }
  }

  /// Records a sentence for the user about something that did not go as wished.
  package func warn(_ sentence: String) {
    state.withLock { $0.warnings.append(sentence) }
  }

  /// Records a sentence for the user who wants to know more.
  package func log(_ sentence: String) {
    state.withLock { $0.details.append(sentence) }
  }

  /// Takes over what another part of the stage has left.
  func add(_ other: StageNotes) {
    let (counts, warnings, details) = (other.counts, other.warnings, other.details)
    state.withLock { state in
      state.counts.merge(counts) { $1 }
      state.warnings += warnings
      state.details += details
    }
  }

  package var counts: [String: Double] { state.withLock { $0.counts } }
  package var warnings: [String] { state.withLock { $0.warnings } }
  package var details: [String] { state.withLock { $0.details } }
}

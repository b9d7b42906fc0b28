import Kernels
import SceneModel

/// What a stage needs besides its input: threads, progress, cancellation and notes for the report.
package struct StageContext: Sendable {
  package let control: KernelControl
  package let notes: StageNotes

  package init(control: KernelControl = KernelControl(), notes: StageNotes = StageNotes()) {
    self.control = control
    self.notes = notes
  }

  /// Reports that unit `index` of `count` begins; throws `CancellationError` if the run was
  /// canceled.
  package func step(_ index: Int, of count: Int) throws {
    try control.step(Double(index) / Double(max(1, count)))
  }

  /// The context of a part of the stage that runs from `start` to `end` of its progress.
  package func part(from start: Double, to end: Double) -> StageContext {
    StageContext(control: control.part(from: start, to: end), notes: notes)
  }
}

/// Counts, warnings and details that a stage records for `report.json`.
package final class StageNotes: Sendable {
  private struct State {
    var counts: [String: Double] = [:]
    var warnings: [String] = []
    var doubts: [String] = []
    var details: [String] = []
  }

  private let state = Locked(State())

  package init() {}

  /// Records a number, for instance `points` or `meanReprojectionError`.
  package func record(_ name: String, _ value: Double) {
    state.withLock { $0.counts[name] = value }
  }

  /// Records a warning for the user, as a sentence.
  package func warn(_ sentence: String) {
    state.withLock { $0.warnings.append(sentence) }
  }

  /// Records a warning, as a sentence, that the model may not be what the user wants: the command
  /// then fails, although it writes the model.
  package func doubt(_ sentence: String) {
    state.withLock {
      $0.warnings.append(sentence)
      $0.doubts.append(sentence)
    }
  }

  /// Records additional information for verbose logs, as a sentence.
  package func log(_ sentence: String) {
    state.withLock { $0.details.append(sentence) }
  }

  /// Adds the notes of another part of the stage.
  func add(_ other: StageNotes) {
    let other = other.state.withLock { $0 }
    state.withLock { state in
      state.counts.merge(other.counts) { $1 }
      state.warnings += other.warnings
      state.doubts += other.doubts
      state.details += other.details
    }
  }

  package var counts: [String: Double] { state.withLock { $0.counts } }
  package var warnings: [String] { state.withLock { $0.warnings } }
  package var doubts: [String] { state.withLock { $0.doubts } }
  package var details: [String] { state.withLock { $0.details } }
}

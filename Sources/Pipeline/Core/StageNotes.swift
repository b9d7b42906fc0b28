import SceneModel

/// Counts, warnings and details that a stage records for `report.json`.
package final class StageNotes: Sendable {
  private struct State {
    var counts: [String: Double] = [:]
    var warnings: [String] = []
    var concerns: [String] = []
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

  /// Records a concern, which is also a warning: a sentence why the model may not be what the user
  /// wants. The command then fails, although it writes the model.
  package func flagAsSuspect(_ sentence: String) {
    state.withLock {
      $0.warnings.append(sentence)
      $0.concerns.append(sentence)
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
      state.concerns += other.concerns
      state.details += other.details
    }
  }

  package var counts: [String: Double] { state.withLock { $0.counts } }
  package var warnings: [String] { state.withLock { $0.warnings } }
  package var concerns: [String] { state.withLock { $0.concerns } }
  package var details: [String] { state.withLock { $0.details } }
}

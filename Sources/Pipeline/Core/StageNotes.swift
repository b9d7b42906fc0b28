import SceneModel

/// Counts, warnings, details, matches and the cost of steps that a stage records for `report.json`.
package final class StageNotes: Sendable {
  private struct State {
    var steps: [StepCost] = []
    var counts: [String: Double] = [:]
    var warnings: [String] = []
    var concerns: [String] = []
    var details: [String] = []
    var matches: MatchRecord?

    mutating func add(_ cost: StepCost) {
      if let index = steps.firstIndex(where: { $0.name == cost.name }) {
        steps[index] += cost
      } else {
        steps.append(cost)
      }
    }
  }

  private let state = Locked(State())
  /// Measures steps; nil outside a run.
  let meter: SerialTimeMeter?

  package init(meter: SerialTimeMeter? = nil) { self.meter = meter }

  /// Runs a step of the stage and records its cost; calls with the same name add up.
  func step<Value>(_ name: String, _ body: () throws -> Value) rethrows -> Value {
    let start = ResourceUsage.now
    let serialStart = meter?.serialSeconds ?? 0
    defer {
      let end = ResourceUsage.now
      let cost = StepCost(
        name: name, seconds: end.seconds - start.seconds,
        cpuSeconds: end.cpuSeconds - start.cpuSeconds,
        serialSeconds: (meter?.serialSeconds ?? 0) - serialStart)
      state.withLock { $0.add(cost) }
    }
    return try body()
  }

  /// Records a number, for instance `points` or `meanReprojectionError`.
  package func record(_ name: String, _ value: Double) {
    state.withLock { $0.counts[name] = value }
  }

  /// Records which photos match; replaces what was recorded before.
  package func record(_ matches: MatchRecord) {
    state.withLock { $0.matches = matches }
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

  /// The steps in the order of their first execution.
  package var steps: [StepCost] { state.withLock { $0.steps } }

  /// Adds the notes of another part of the stage.
  func add(_ other: StageNotes) {
    let other = other.state.withLock { $0 }
    state.withLock { state in
      state.counts.merge(other.counts) { $1 }
      other.steps.forEach { state.add($0) }
      state.warnings += other.warnings
      state.concerns += other.concerns
      state.details += other.details
      state.matches = other.matches ?? state.matches
    }
  }

  package var counts: [String: Double] { state.withLock { $0.counts } }
  package var warnings: [String] { state.withLock { $0.warnings } }
  package var concerns: [String] { state.withLock { $0.concerns } }
  package var details: [String] { state.withLock { $0.details } }
  package var matches: MatchRecord? { state.withLock { $0.matches } }
}

/// Estimates the completed fraction and the remaining time of a run.
///
/// Starts from the expected duration of each unit of work and corrects it by measurements: finished
/// units give the speed of the machine, and the current unit is extrapolated with a weight that
/// grows with its progress.
package struct ProgressEstimator: Sendable {
  private struct Step {
    var unit: WorkUnit
    /// The expected duration in seconds.
    var prior: Double
    var fraction = 0.0
    /// The measured duration so far, in seconds.
    var seconds = 0.0

    /// The weight of its duration as evidence of the machine's speed. It is lower for alignment,
    /// whose duration depends on the photos (the number of features and of overlapping pairs), and
    /// for meshing, whose duration depends on the shape.
    var evidence: Double { [.imageAlignment, .meshGeneration].contains(unit.stage) ? 0.1 : 1 }

    var isDone: Bool { fraction >= 1 }
    /// Whether the work was done in this run: a reused result takes less than a fiftieth of the
    /// expected time.
    var isMeasured: Bool { fraction > 0 && seconds > 0.02 * prior * fraction }
  }

  private var steps: [Step]
  private var lastTime: Double

  /// Starts at `time`, in seconds. `units` are in the order of work; `prior` returns the expected
  /// duration of a unit in seconds.
  package init(units: [WorkUnit], at time: Double, prior: (WorkUnit) -> Double) {
    steps = units.map { Step(unit: $0, prior: max(0, prior($0))) }
    lastTime = time
  }

  /// Replaces the expected durations when more is known about the input.
  package mutating func reweigh(_ prior: (WorkUnit) -> Double) {
    for index in steps.indices { steps[index].prior = max(0, prior(steps[index].unit)) }
  }

  /// Records that a unit has reached a fraction of its work; progress never decreases.
  package mutating func advance(_ unit: WorkUnit, to fraction: Double, at time: Double) {
    guard let index = steps.firstIndex(where: { $0.unit == unit }), fraction.isFinite else {
      return
    }
    if !steps[index].isDone { steps[index].seconds += max(0, time - lastTime) }
    steps[index].fraction = min(1, max(fraction, steps[index].fraction))
    lastTime = max(lastTime, time)
  }

  /// Records that a unit has `factor` times as much work as was expected: what is done is a smaller
  /// fraction of it.
  package mutating func extend(_ unit: WorkUnit, by factor: Double) {
    guard let index = steps.firstIndex(where: { $0.unit == unit }), factor > 1, factor.isFinite,
      !steps[index].isDone
    else { return }
    steps[index].prior *= factor
    steps[index].fraction /= factor
  }

  /// Removes units that are no longer needed.
  package mutating func remove(_ isObsolete: (WorkUnit) -> Bool) {
    steps.removeAll { isObsolete($0.unit) }
  }

  /// The completed fraction of some units, from 0 to 1, weighted by expected durations.
  package func fraction(of units: [WorkUnit]) -> Double {
    let needed = steps.filter { units.contains($0.unit) }
    let total = needed.reduce(0) { $0 + $1.prior }
    guard total > 0 else { return needed.allSatisfy(\.isDone) ? 1 : 0 }
    return min(1, needed.reduce(0) { $0 + $1.prior * $1.fraction } / total)
  }

  /// Seconds until the last of the units is done, including all units before it; nil before
  /// anything is measured.
  package func remainingSeconds(of units: [WorkUnit]) -> Double? {
    guard let last = steps.lastIndex(where: { units.contains($0.unit) }), let speed else {
      return nil
    }
    return steps[...last].reduce(0) { $0 + remainingSeconds(of: $1, speed: speed) }
  }

  /// Measured seconds per expected second; nil before a hundredth of the work is measured.
  private var speed: Double? {
    let measured = steps.filter(\.isMeasured)
    let done = measured.reduce(0) { $0 + $1.prior * $1.fraction }
    let total = done + steps.reduce(0) { $0 + $1.prior * (1 - $1.fraction) }
    guard done > 0, done > 0.01 * total else { return nil }
    let expected = measured.reduce(0) { $0 + $1.evidence * $1.prior * $1.fraction }
    let seconds = measured.reduce(0) { $0 + $1.evidence * $1.seconds }
    // A small amount of work may be atypical: the prior keeps some weight until a tenth is
    // measured.
    let weight = 0.03 * max(0, total - 10 * expected)
    return (seconds + weight) / (expected + weight)
  }

  private func remainingSeconds(of step: Step, speed: Double) -> Double {
    let expected = step.prior * speed
    guard step.isMeasured else { return expected * (1 - step.fraction) }
    let extrapolated = step.seconds / step.fraction
    let total = expected + (extrapolated - expected) * step.fraction
    return total * (1 - step.fraction)
  }
}

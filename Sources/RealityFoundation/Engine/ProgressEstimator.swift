/// Tells how far a run is and how long it will take.
///
/// Begins with the usual duration of each unit of work and corrects it by what is measured: units
/// that are done say how fast the machine is, and the current one is extrapolated the more its
/// progress tells.
struct ProgressEstimator: Sendable {
  private struct Step {
    var unit: WorkUnit
    /// The usual duration in seconds.
    var prior: Double
    var fraction = 0.0
    /// Measured so far, in seconds.
    var seconds = 0.0

    /// How much its duration tells of the machine. That of an alignment tells of the photos: of how
    /// many features they have, and how many of the pairs show the same; that of a mesh of the shape.
    var evidence: Double { [.imageAlignment, .meshGeneration].contains(unit.stage) ? 0.1 : 1 }

    var isDone: Bool { fraction >= 1 }
    /// Whether the work was really done and not taken over from an earlier run.
    var isMeasured: Bool { fraction > 0 && seconds > 0.02 * prior * fraction }
  }

  private var steps: [Step]
  private var lastTime: Double

  /// Begins at `time`, in seconds, with units in the order that they are worked on.
  init(units: [WorkUnit], at time: Double, prior: (WorkUnit) -> Double) {
    steps = units.map { Step(unit: $0, prior: max(0, prior($0))) }
    lastTime = time
  }

  /// Replaces the usual durations, once more is known about the input.
  mutating func reweigh(_ prior: (WorkUnit) -> Double) {
    for index in steps.indices { steps[index].prior = max(0, prior(steps[index].unit)) }
  }

  /// Records that a unit has come to a fraction; progress never goes back.
  mutating func advance(_ unit: WorkUnit, to fraction: Double, at time: Double) {
    guard let index = steps.firstIndex(where: { $0.unit == unit }), fraction.isFinite else {
      return
    }
    if !steps[index].isDone { steps[index].seconds += max(0, time - lastTime) }
    steps[index].fraction = min(1, max(fraction, steps[index].fraction))
    lastTime = max(lastTime, time)
  }

  /// Takes units off that are not needed any more.
  mutating func remove(_ isObsolete: (WorkUnit) -> Bool) { steps.removeAll { isObsolete($0.unit) } }

  /// How much of the units is done, from 0 to 1, weighted by their usual durations.
  func fraction(of units: [WorkUnit]) -> Double {
    let needed = steps.filter { units.contains($0.unit) }
    let total = needed.reduce(0) { $0 + $1.prior }
    guard total > 0 else { return needed.allSatisfy(\.isDone) ? 1 : 0 }
    return min(1, needed.reduce(0) { $0 + $1.prior * $1.fraction } / total)
  }

  /// Seconds until the last of the units is done, those in between included; nil before there is
  /// anything to go by.
  func remainingSeconds(of units: [WorkUnit]) -> Double? {
    guard let last = steps.lastIndex(where: { units.contains($0.unit) }), let speed else {
      return nil
    }
    return steps[...last].reduce(0) { $0 + remainingSeconds(of: $1, speed: speed) }
  }

  /// Measured seconds per usual second; nil before a hundredth of the work is measured.
  private var speed: Double? {
    let measured = steps.filter(\.isMeasured)
    let done = measured.reduce(0) { $0 + $1.prior * $1.fraction }
    let total = done + steps.reduce(0) { $0 + $1.prior * (1 - $1.fraction) }
    guard done > 0, done > 0.01 * total else { return nil }
    let usual = measured.reduce(0) { $0 + $1.evidence * $1.prior * $1.fraction }
    let seconds = measured.reduce(0) { $0 + $1.evidence * $1.seconds }
    // Little work may be out of the ordinary: until a tenth is measured, the prior has a say.
    let weight = 0.03 * max(0, total - 10 * usual)
    return (seconds + weight) / (usual + weight)
  }

  private func remainingSeconds(of step: Step, speed: Double) -> Double {
    let expected = step.prior * speed
    guard step.isMeasured else { return expected * (1 - step.fraction) }
    let extrapolated = step.seconds / step.fraction
    let total = expected + (extrapolated - expected) * step.fraction
    return total * (1 - step.fraction)
  }
}

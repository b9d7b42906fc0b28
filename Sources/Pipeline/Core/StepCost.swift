/// The cost of a step of a stage. Steps may contain others.
package struct StepCost: Hashable, Codable, Sendable {
  package var name: String
  /// Wall-clock time.
  package var seconds: Double
  /// User and system time of all threads.
  package var cpuSeconds: Double
  /// The part of `seconds` in which fewer than two threads were busy.
  package var serialSeconds: Double

  static func += (sum: inout StepCost, other: StepCost) {
    sum.seconds += other.seconds
    sum.cpuSeconds += other.cpuSeconds
    sum.serialSeconds += other.serialSeconds
  }
}

import Foundation
import Testing

@testable import Pipeline

@Suite struct StepCostTests {
  /// Half a second of one, one and a half, two and eight busy threads, and of none.
  @Test(arguments: [(0.5, 0.5), (0.75, 0.25), (1, 0), (4, 0), (0, 0.5)])
  func serialTimeIsThatOfLessThanTwoThreads(cpuSeconds: Double, expected: Double) {
    #expect(SerialTimeMeter.serialSeconds(in: 0.5, cpuSeconds: cpuSeconds) == expected)
  }

  @Test func clocksThatStandStillAddNothing() {
    #expect(SerialTimeMeter.serialSeconds(in: 0, cpuSeconds: 0) == 0)
    #expect(SerialTimeMeter.serialSeconds(in: -1, cpuSeconds: 0) == 0)
  }

  @Test func stepsWithOneNameAddUp() throws {
    struct Failure: Error {}
    let meter = SerialTimeMeter()
    defer { meter.stop() }
    let notes = StageNotes(meter: meter)
    let start = ResourceUsage.now.seconds
    #expect(notes.step("a") { 7 } == 7)
    notes.step("b") { Thread.sleep(forTimeInterval: 0.02) }
    #expect(throws: Failure.self) {
      try notes.step("a") {
        Thread.sleep(forTimeInterval: 0.01)
        throw Failure()
      }
    }
    let elapsed = ResourceUsage.now.seconds - start
    let other = StageNotes(meter: meter)
    other.step("c") {}
    notes.add(other)
    #expect(notes.steps.map(\.name) == ["a", "b", "c"])
    #expect(notes.steps[0].seconds >= 0.01 && notes.steps[1].seconds >= 0.02)
    #expect(notes.steps.reduce(0) { $0 + $1.seconds } <= elapsed + 0.01)
    for step in notes.steps {
      #expect(step.cpuSeconds >= 0 && step.serialSeconds >= 0)
      #expect(step.serialSeconds <= step.seconds + 0.01)
    }
  }
}

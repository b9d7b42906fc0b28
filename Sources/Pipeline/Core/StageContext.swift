import Kernels

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

import Kernels

/// What a stage needs besides its input: threads, progress, cancellation and notes for the report.
package struct StageContext: Sendable {
  package let control: KernelControl
  package let notes: StageNotes
  /// Receives the factor by which the work of the stage grows.
  private let onExtension: @Sendable (Double) -> Void

  package init(
    control: KernelControl = KernelControl(), notes: StageNotes = StageNotes(),
    onExtension: @escaping @Sendable (Double) -> Void = { _ in }
  ) {
    self.control = control
    self.notes = notes
    self.onExtension = onExtension
  }

  /// Reports that unit `index` of `count` begins; throws `CancellationError` if the run was
  /// canceled.
  package func step(_ index: Int, of count: Int) throws {
    try control.step(Double(index) / Double(max(1, count)))
  }

  /// The context of a part of the stage that runs from `start` to `end` of its progress.
  package func part(from start: Double, to end: Double) -> StageContext {
    StageContext(
      control: control.part(from: start, to: end), notes: notes, onExtension: onExtension)
  }

  /// The context of one of some parts of the same length.
  func part(_ index: Int, of count: Int) -> StageContext {
    part(from: Double(index) / Double(count), to: Double(index + 1) / Double(count))
  }

  /// Reports that the stage takes `factor` times as long as was expected, and returns the context
  /// of the rest after `done`, the fraction of the expected work. Only for the context of a whole
  /// stage.
  func extended(by factor: Double, after done: Double) -> StageContext {
    onExtension(factor)
    return part(from: done / factor, to: 1)
  }
}

import Synchronization

/// A one-way flag that cancels a run.
package final class CancellationFlag: Sendable {
  private let value = Atomic<Bool>(false)

  package init() {}

  /// Whether the run is canceled.
  package var isCancelled: Bool { value.load(ordering: .relaxed) }

  /// Cancels the run; can't be undone.
  package func cancel() { value.store(true, ordering: .relaxed) }
}

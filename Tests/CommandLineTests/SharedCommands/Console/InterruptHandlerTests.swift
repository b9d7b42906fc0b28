import Foundation
import Synchronization
import Testing

@testable import SharedCommands

@Suite(.serialized) struct InterruptHandlerTests {
  private final class Counter: Sendable {
    let calls = Atomic<Int>(0)
  }

  /// One handler in this process only: the second signal that a handler receives ends the process.
  /// `DensifyTests` and `ExportTests` send both signals to processes.
  @Test func firstSignalRequestsAStop() throws {
    let counter = Counter()
    let handler = InterruptHandler { counter.calls.add(1, ordering: .relaxed) }
    #expect(!handler.wasInterrupted)
    kill(getpid(), SIGINT)
    let end = Date().addingTimeInterval(10)
    while counter.calls.load(ordering: .relaxed) == 0, Date() < end { usleep(1000) }
    #expect(handler.wasInterrupted)
    #expect(counter.calls.load(ordering: .relaxed) == 1)
  }
}

import Foundation
import Synchronization

/// Turns the first SIGINT or SIGTERM into a request to stop; the second one ends the process,
/// unless it means something else.
package final class InterruptHandler: Sendable {
  private final class Requests: Sendable {
    let signals = Atomic<Int>(0)
    let hasInputEnded = Atomic<Bool>(false)
  }

  private let requests: Requests
  private let listener: UUID

  /// Whether a stop was requested.
  package var wasInterrupted: Bool {
    requests.signals.load(ordering: .relaxed) > 0
      || requests.hasInputEnded.load(ordering: .relaxed)
  }

  /// Calls `onFirst` at the first signal, on another thread; it may be called more than once. Each
  /// further one calls `onSecond`, if given. `message` is printed at the first.
  ///
  /// With `untilInputEnds` the end of standard input requests a stop, too, and ends the process two
  /// seconds later: the process at the other end is gone. Both may arrive: a signal to the process
  /// group reaches parent and child.
  package init(
    untilInputEnds: Bool = false,
    message: String = "Stopping; press Ctrl-C again to quit immediately.",
    onSecond: (@Sendable () -> Void)? = nil, _ onFirst: @escaping @Sendable () -> Void
  ) {
    let requests = Requests()
    self.requests = requests
    listener = SignalPipe.shared.add([SIGINT, SIGTERM]) {
      Self.received(requests, message, onFirst, onSecond)
    }
    guard untilInputEnds else { return }
    Thread.detachNewThread {
      while !FileHandle.standardInput.availableData.isEmpty {}
      requests.hasInputEnded.store(true, ordering: .relaxed)
      onFirst()
      // The parent is gone: a step that can't be canceled must not keep this process alive.
      Thread.sleep(forTimeInterval: 2)
      _exit(CommandFailure.interruptedCode)
    }
  }

  deinit { SignalPipe.shared.remove(listener) }

  private static func received(
    _ requests: Requests, _ message: String, _ onFirst: @Sendable () -> Void,
    _ onSecond: (@Sendable () -> Void)?
  ) {
    if requests.signals.add(1, ordering: .relaxed).oldValue == 0 {
      Terminal.shared.message(message)
      onFirst()
    } else if let onSecond {
      onSecond()
    } else {
      Terminal.shared.show(status: "")
      // Not `exit`, which would wait for working threads.
      _exit(CommandFailure.interruptedCode)
    }
  }
}

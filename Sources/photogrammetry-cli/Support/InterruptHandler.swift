import Foundation
import Synchronization

/// Turns Ctrl-C and SIGTERM into a wish to stop; the second one ends the process at once.
final class InterruptHandler: Sendable {
  private final class Counter: Sendable {
    let value = Atomic<Int>(0)
  }

  private let counter: Counter
  // Kept alive only; nothing is read from them.
  private nonisolated(unsafe) let sources: [any DispatchSourceSignal]

  /// Whether a signal came.
  var wasInterrupted: Bool { counter.value.load(ordering: .relaxed) > 0 }

  /// Calls `onFirst` at the first signal, on a queue of its own.
  init(_ onFirst: @escaping @Sendable () -> Void) {
    let counter = Counter()
    self.counter = counter
    sources = [SIGINT, SIGTERM].map { number in
      signal(number, SIG_IGN)
      let source = DispatchSource.makeSignalSource(signal: number, queue: .global())
      source.setEventHandler { Self.received(counter, onFirst) }
      source.resume()
      return source
    }
  }

  private static func received(_ counter: Counter, _ onFirst: @Sendable () -> Void) {
    if counter.value.add(1, ordering: .relaxed).oldValue == 0 {
      Terminal.shared.message("Stopping; press Ctrl-C again to end at once.")
      onFirst()
    } else {
      Terminal.shared.show(status: "")
      exit(CommandFailure.interruptedCode)
    }
  }
}

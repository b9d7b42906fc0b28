import Foundation
import Synchronization

/// Turns Ctrl-C and SIGTERM into a wish to stop; the second one ends the process at once.
final class InterruptHandler: Sendable {
  private final class Wishes: Sendable {
    let signals = Atomic<Int>(0)
    let hasInputEnded = Atomic<Bool>(false)
  }

  private let wishes: Wishes
  // Kept alive only; nothing is read from them.
  private nonisolated(unsafe) let sources: [any DispatchSourceSignal]

  /// Whether there was such a wish.
  var wasInterrupted: Bool {
    wishes.signals.load(ordering: .relaxed) > 0 || wishes.hasInputEnded.load(ordering: .relaxed)
  }

  /// Calls `onFirst` at the first signal, on a queue of its own; once more is harmless. With
  /// `untilInputEnds` the end of standard input is a wish to stop too, soon: it comes when the process
  /// at its other end is gone, and beside a signal that both have got.
  init(untilInputEnds: Bool = false, _ onFirst: @escaping @Sendable () -> Void) {
    let wishes = Wishes()
    self.wishes = wishes
    sources = [SIGINT, SIGTERM].map { number in
      signal(number, SIG_IGN)
      let source = DispatchSource.makeSignalSource(signal: number, queue: .global())
      source.setEventHandler { Self.received(wishes, onFirst) }
      source.resume()
      return source
    }
    guard untilInputEnds else { return }
    Thread.detachNewThread {
      while !FileHandle.standardInput.availableData.isEmpty {}
      wishes.hasInputEnded.store(true, ordering: .relaxed)
      onFirst()
      // Nobody waits for this process: a step that can't be left must not hold it for long.
      Thread.sleep(forTimeInterval: 2)
      _exit(CommandFailure.interruptedCode)
    }
  }

  private static func received(_ wishes: Wishes, _ onFirst: @Sendable () -> Void) {
    if wishes.signals.add(1, ordering: .relaxed).oldValue == 0 {
      Terminal.shared.message("Stopping; press Ctrl-C again to end at once.")
      onFirst()
    } else {
      Terminal.shared.show(status: "")
      // Not `exit`, which would wait for threads that work.
      _exit(CommandFailure.interruptedCode)
    }
  }
}

import Foundation
import SceneModel

/// The write end of the pipe that the signal handler writes to, since a signal handler can't
/// capture anything.
private nonisolated(unsafe) var signalPipeInput: Int32 = -1

/// Delivers signals to listeners, on a thread of its own (the self-pipe trick, D. J. Bernstein).
///
/// No signal is lost once a handler is installed. A dispatch source would lose those that arrive
/// before it is active, because the signal has to be ignored by then.
final class SignalPipe: Sendable {
  static let shared = SignalPipe()

  private let listeners = Locked<[UUID: @Sendable () -> Void]>([:])

  private init() {
    var ends: [Int32] = [-1, -1]
    guard pipe(&ends) == 0 else { return }
    signalPipeInput = ends[1]
    let output = ends[0]
    Thread.detachNewThread { [listeners] in
      var byte: UInt8 = 0
      while true {
        let count = read(output, &byte, 1)
        guard count == 1 || (count < 0 && errno == EINTR) else { return }
        guard count == 1 else { continue }
        for body in listeners.withLock({ Array($0.values) }) { body() }
      }
    }
  }

  /// Calls `body` at each of the signals from now on, until the result is passed to `remove`.
  func add(_ signals: [Int32], _ body: @escaping @Sendable () -> Void) -> UUID {
    let id = UUID()
    listeners.withLock { $0[id] = body }
    for number in signals {
      signal(number) { _ in
        let error = errno
        var byte: UInt8 = 0
        _ = write(signalPipeInput, &byte, 1)
        errno = error
      }
    }
    return id
  }

  func remove(_ id: UUID) {
    listeners.withLock { $0[id] = nil }
  }
}

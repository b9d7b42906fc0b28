import Foundation
import SceneModel

/// A thread that calls a function at regular times, until `stop()`.
final class PeriodicThread: Sendable {
  private let isStopped = Locked(false)
  private let condition = NSCondition()

  /// `interval` is in seconds; the first call is one interval from now.
  init(_ name: String, interval: Double, _ body: @escaping @Sendable () -> Void) {
    let (isStopped, condition) = (isStopped, condition)
    let thread = Thread {
      condition.lock()
      defer { condition.unlock() }
      while !isStopped.withLock({ $0 }) {
        _ = condition.wait(until: Date(timeIntervalSinceNow: interval))
        body()
      }
    }
    thread.name = name
    thread.start()
  }

  /// Ends the thread after the call that is under way.
  func stop() {
    isStopped.withLock { $0 = true }
    condition.lock()
    condition.broadcast()
    condition.unlock()
  }
}

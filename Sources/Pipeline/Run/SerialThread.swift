import Foundation
import SceneModel

/// A thread that runs jobs one after another on a value that never leaves it.
///
/// Starts with the first job and ends after `stop()`. The numeric stages block for minutes, which
/// is not allowed on threads of Swift's cooperative pool.
package final class SerialThread<Local>: Sendable {
  /// A unit of work with exclusive access to the thread's value.
  package typealias Job = @Sendable (inout Local) -> Void

  private struct Queue {
    var jobs: [Job] = []
    var isStarted = false
    var isStopped = false
  }

  private let name: String
  private let makeLocal: @Sendable () -> Local
  private let condition = NSCondition()
  private let queue = Locked(Queue())

  package init(name: String, makeLocal: @escaping @Sendable () -> Local) {
    self.name = name
    self.makeLocal = makeLocal
  }

  /// Adds a job; has no effect after `stop()`.
  package func submit(_ job: @escaping Job) {
    let starts = queue.withLock { queue -> Bool in
      guard !queue.isStopped else { return false }
      queue.jobs.append(job)
      defer { queue.isStarted = true }
      return !queue.isStarted
    }
    if starts { start() }
    wake()
  }

  /// Ends the thread after the pending jobs.
  package func stop() {
    queue.withLock { $0.isStopped = true }
    wake()
  }

  /// Bytes of the thread's stack. Chosen.
  private static var stackSize: Int { 16 << 20 }

  private func start() {
    let thread = Thread { [self] in
      var local = makeLocal()
      while let job = next() { job(&local) }
    }
    thread.name = name
    thread.stackSize = Self.stackSize
    thread.start()
  }

  private func wake() {
    condition.lock()
    condition.broadcast()
    condition.unlock()
  }

  /// Waits for a job; nil after `stop()` when no job is pending.
  private func next() -> Job? {
    condition.lock()
    defer { condition.unlock() }
    while true {
      let (job, isStopped) = queue.withLock { queue in
        (queue.jobs.isEmpty ? nil : queue.jobs.removeFirst(), queue.isStopped)
      }
      if let job { return job }
      if isStopped { return nil }
      condition.wait()
    }
  }
}

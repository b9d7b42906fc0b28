import Foundation
import SceneModel

/// Measures for how long fewer than two threads of the process are busy, by sampling its processor
/// time. The thread that samples runs until `stop()`.
package final class SerialTimeMeter: Sendable {
  private struct State {
    var serialSeconds = 0.0
    var last = Sample.now
    var isStopped = false
  }

  private struct Sample {
    var seconds: Double
    var cpuSeconds: Double

    static var now: Sample {
      Sample(seconds: time(CLOCK_MONOTONIC), cpuSeconds: time(CLOCK_PROCESS_CPUTIME_ID))
    }

    private static func time(_ clock: clockid_t) -> Double {
      var time = timespec()
      clock_gettime(clock, &time)
      return Double(time.tv_sec) + Double(time.tv_nsec) * 1e-9
    }
  }

  /// Seconds between two samples. Chosen: several ticks of the kernel, which counts the time of
  /// running threads at each of them.
  private static let interval = 0.02

  private let state = Locked(State())
  private let condition = NSCondition()

  package init() {
    let thread = Thread { [self] in
      condition.lock()
      defer { condition.unlock() }
      while !state.withLock({ $0.isStopped }) {
        _ = condition.wait(until: Date(timeIntervalSinceNow: Self.interval))
        sample()
      }
    }
    thread.name = "serial time"
    thread.start()
  }

  /// The serial time so far, in seconds.
  package var serialSeconds: Double {
    sample()
    return state.withLock { $0.serialSeconds }
  }

  package func stop() {
    state.withLock { $0.isStopped = true }
    condition.lock()
    condition.broadcast()
    condition.unlock()
  }

  /// Adds the time since the last sample, if fewer than two threads were busy in it. Between one
  /// and two threads on average, both are taken to have been busy for a part of it.
  private func sample() {
    state.withLock { state in
      // In the lock, so that samples of different threads are in order.
      let now = Sample.now
      state.serialSeconds += Self.serialSeconds(
        in: now.seconds - state.last.seconds, cpuSeconds: now.cpuSeconds - state.last.cpuSeconds)
      state.last = now
    }
  }

  /// The serial part of an interval.
  static func serialSeconds(in seconds: Double, cpuSeconds: Double) -> Double {
    min(max(2 * seconds - cpuSeconds, 0), max(seconds, 0))
  }
}

import Foundation
import SceneModel

/// Measures for how long fewer than two threads of the process are busy, by sampling its processor
/// time. The thread that samples runs until `stop()`.
package final class SerialTimeMeter: Sendable {
  private struct State {
    var serialSeconds = 0.0
    var last = Sample.now
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

  private let state: Locked<State>
  private let thread: PeriodicThread

  package init() {
    let state = Locked(State())
    self.state = state
    thread = PeriodicThread("serial time", interval: Self.interval) { Self.sample(state) }
  }

  /// The serial time so far, in seconds.
  package var serialSeconds: Double {
    Self.sample(state)
    return state.withLock { $0.serialSeconds }
  }

  package func stop() { thread.stop() }

  /// Adds the time since the last sample, if fewer than two threads were busy in it. Between one
  /// and two threads on average, both are taken to have been busy for a part of it.
  private static func sample(_ state: Locked<State>) {
    state.withLock { state in
      // In the lock, so that samples of different threads are in order.
      let now = Sample.now
      state.serialSeconds += serialSeconds(
        in: now.seconds - state.last.seconds, cpuSeconds: now.cpuSeconds - state.last.cpuSeconds)
      state.last = now
    }
  }

  /// The serial part of an interval.
  static func serialSeconds(in seconds: Double, cpuSeconds: Double) -> Double {
    min(max(2 * seconds - cpuSeconds, 0), max(seconds, 0))
  }
}

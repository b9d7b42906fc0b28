import Dispatch

/// Runs a task's jobs on a queue of its own.
///
/// Long tests occupy the threads that all tasks share, so that a test can wait for minutes at an
/// `await`. A test that has to act while something else is still working runs here:
/// `withTaskExecutorPreference(QueueExecutor()) { … }`.
public final class QueueExecutor: TaskExecutor {
  private let queue = DispatchQueue(label: "QueueExecutor")

  /// Makes a queue.
  public init() {}

  /// Runs a job after those that were enqueued before it.
  public func enqueue(_ job: consuming ExecutorJob) {
    let job = UnownedJob(job)
    queue.async { job.runSynchronously(on: self.asUnownedTaskExecutor()) }
  }
}

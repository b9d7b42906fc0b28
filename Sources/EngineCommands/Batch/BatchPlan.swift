/// The number of datasets that are processed at once, and the threads of each.
struct BatchPlan: Equatable, Sendable {
  var jobs: Int
  var threads: Int
  /// Whether the memory allows fewer jobs than were requested.
  var isLimitedByMemory = false

  /// Runs one job per processor, as far as `memory` allows at `memoryOfJob` bytes per job: stages
  /// with a single thread, such as meshing, leave processors idle, so that many jobs give the
  /// highest throughput. Processors that remain are distributed as threads.
  init(
    datasets: Int, requestedJobs: Int?, requestedThreads: Int?, processors: Int, memory: Int,
    memoryOfJob: Int
  ) {
    let fitting = max(1, memory / memoryOfJob)
    let requested = max(1, min(requestedJobs ?? processors, datasets))
    jobs = min(requested, fitting)
    threads = requestedThreads ?? max(1, (processors + jobs - 1) / jobs)
    isLimitedByMemory = requestedJobs != nil && jobs < requested
  }
}

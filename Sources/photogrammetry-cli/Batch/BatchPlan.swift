#if canImport(Pipeline)
  import Pipeline

  /// How many datasets are worked on at once, and with how many threads each.
  struct BatchPlan: Equatable {
    var jobs: Int
    var threads: Int
    /// Whether the memory allows fewer jobs than were asked for.
    var isLimitedByMemory = false

    /// Stages that take one thread, such as meshing, leave processors idle; so as many jobs as there
    /// are processors are best for the whole, and what is left over is shared out as threads.
    init(
      datasets: Int, wishedJobs: Int?, wishedThreads: Int?, processors: Int, memory: Int,
      memoryOfJob: Int
    ) {
      let fitting = max(1, memory / memoryOfJob)
      let wish = max(1, min(wishedJobs ?? processors, datasets))
      jobs = min(wish, fitting)
      threads = wishedThreads ?? max(1, (processors + jobs - 1) / jobs)
      isLimitedByMemory = wishedJobs != nil && jobs < wish
    }

    /// Bytes that a run at a level takes at most, as a rule: twice what runs of some 50 photos took.
    static func memory(for detail: DetailChoice) -> Int {
      switch detail {
      case .level(.preview), .level(.reduced): Machine.neededMemoryBytes
      case .level(.medium), .custom: 3 << 30
      case .level(.full): 4 << 30
      case .level(.raw): 8 << 30
      }
    }
  }
#endif

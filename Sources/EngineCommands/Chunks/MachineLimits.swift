import Pipeline

/// The limits that follow from the memory of a machine, as arguments: all chunks of a plan work
/// within those of the machine that made the plan, so that their results don't depend on where they
/// are made.
enum MachineLimits {
  /// For a set of `photos` photos if it is divided into chunks: each then needs the memory of its
  /// own part only.
  static func arguments(photos: Int = 0) -> [String] {
    let limits = Machine.current.limits
    return [
      ("ingestion.memoryBudget", limits.imageMemory),
      ("ingestion.maximumPhotos", min(max(photos, limits.maximumPhotos), MemoryLimits.mostPhotos)),
      ("ingestion.inspection.limits.maximumSide", limits.maximumPhotoSide),
      ("pointCloudGeneration.maximumPoints", limits.cloudPoints),
      ("meshGeneration.poisson.maximumBytes", limits.surfaceMemory),
    ].flatMap { ["--set", "\($0)=\($1)"] }
  }
}

extension Chunk {
  /// Threads of a chunk unless the user says otherwise: a third of a run uses one thread, so that
  /// more would be idle half of the time. Chosen.
  static let usualThreads = 4
  /// Memory of a job besides the usual upper bound of a run: for the process that watches the run,
  /// and for the files that it reads. Chosen.
  static let spareMemory = 512 << 20
}

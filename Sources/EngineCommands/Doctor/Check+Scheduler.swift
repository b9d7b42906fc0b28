extension Check {
  /// Slurm, if there is any: what it means for a run.
  static func scheduler(environment: [String: String], hasBatchCommand: Bool) -> Check? {
    if let job = environment["SLURM_JOB_ID"] {
      let processors = environment["SLURM_CPUS_PER_TASK"].map { " with \($0) processors" } ?? ""
      return Check(
        .scheduler, .note,
        "This is Slurm job \(job)\(processors); the memory above is that of the machine unless the "
          + "job's limit is visible to it.")
    }
    guard hasBatchCommand else { return nil }
    return Check(
      .scheduler, .note,
      "Slurm is installed: what is checked here is not the nodes that jobs run on.",
      remedy: "Check a node with 'srun photogrammetry-cli doctor'. With --slurm, 'batch' and "
        + "'reconstruct' do their work on the cluster.")
  }
}

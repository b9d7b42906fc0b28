extension Check {
  /// How many threads can work at the same time.
  static func threads(_ share: ProcessorShare) -> Check {
    let processors = "\(share.installed) processor\(share.installed == 1 ? "" : "s")"
    let remedy =
      "Add '--threads \(share.threads)': a run has a thread for each processor otherwise."
    if share.threads < share.usable {
      return Check(
        .threads, .note,
        "\(share.usable) of \(processors) may be used, but the quota of the container or job is "
          + "\(rounded(share.quota ?? 0)).",
        remedy: remedy)
    }
    if share.usable < share.installed {
      return Check(
        .threads, .note,
        "\(share.usable) of \(processors) may be used: a job, a container or 'taskset' restricts "
          + "the process to them.",
        remedy: remedy)
    }
    return Check(.threads, .ok, "\(processors) may be used.")
  }

  private static func rounded(_ quota: Double) -> String { "\((quota * 10).rounded() / 10)" }
}

import Pipeline

extension Check {
  /// How many threads can work at the same time.
  static func threads(_ share: ProcessorShare) -> Check {
    let processors = "\(share.installed) processor\(share.installed == 1 ? "" : "s")"
    if share.threads < share.usable {
      return Check(
        .threads, .note,
        "\(share.usable) of \(processors) may be used, and the quota of the container or job is "
          + "\(rounded(share.quota ?? 0)): a run has \(threads(share.threads)).")
    }
    if share.usable < share.installed {
      return Check(
        .threads, .note,
        "\(share.usable) of \(processors) may be used: a job, a container or 'taskset' restricts "
          + "the process to them.")
    }
    return Check(.threads, .ok, "\(processors) may be used.")
  }

  private static func threads(_ count: Int) -> String { "\(count) thread\(count == 1 ? "" : "s")" }

  private static func rounded(_ quota: Double) -> String { "\((quota * 10).rounded() / 10)" }
}

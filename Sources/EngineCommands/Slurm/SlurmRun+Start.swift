import Foundation
import SharedCommands

extension SlurmArguments {
  /// Throws a `CommandFailure` if Slurm is wanted, but not installed.
  func check() throws {
    if slurm { _ = try Slurm() }
  }
}

extension SlurmSettings {
  /// The settings of a command with `arguments`. Throws a `CommandFailure` if Slurm is not
  /// installed.
  init(_ arguments: SlurmArguments, retries: Int) throws {
    let slurm = try Slurm()
    let processors = slurm.processorsPerNode(partition: arguments.partition)
    maximumMegabytes = slurm.megabytesPerNode(partition: arguments.partition)
    (options, self.retries) = (arguments.batchOptions, retries)
    maximumThreads = processors ?? .max
    program = try FileManager.default.destinationOfSymbolicLink(atPath: "/proc/self/exe")
  }
}

extension SlurmRun {
  /// The run of the plan in a folder if it has jobs that wait or run: the plan must not change
  /// until they end. Nil if there are none.
  static func inProgress(_ url: URL) throws -> SlurmRun? {
    guard let folder = try? PlanFolder(reading: url), let run = try? SlurmRun(folder),
      try !run.jobs().isEmpty
    else { return nil }
    return run
  }
}

import Foundation

/// The machine and the scheduler's job that this process runs in.
enum Node {
  /// The name of the machine: that of the scheduler, or of the system.
  static var name: String {
    environment["SLURMD_NODENAME"] ?? systemName
  }

  /// Not `ProcessInfo.hostName`, which may ask a name server.
  private static var systemName: String {
    var name = [CChar](repeating: 0, count: Int(HOST_NAME_MAX) + 1)
    guard gethostname(&name, name.count - 1) == 0 else { return "unknown" }
    return String(decoding: name.prefix { $0 != 0 }.map { UInt8(bitPattern: $0) }, as: UTF8.self)
  }

  /// The scheduler's name of the job, such as `1234_7`; nil outside one.
  static var job: String? {
    if let array = environment["SLURM_ARRAY_JOB_ID"], let task = environment["SLURM_ARRAY_TASK_ID"]
    {
      return "\(array)_\(task)"
    }
    return environment["SLURM_JOB_ID"] ?? environment["JOB_ID"]
  }

  /// The number of the job in its array; nil outside one. SGE calls it `SGE_TASK_ID`.
  static var taskNumber: Int? {
    (environment["SLURM_ARRAY_TASK_ID"] ?? environment["SGE_TASK_ID"]).flatMap { Int($0) }
  }

  /// The processors that the scheduler gave to the job; nil if it doesn't say.
  static var processors: Int? {
    (environment["SLURM_CPUS_PER_TASK"] ?? environment["NSLOTS"]).flatMap { Int($0) }
  }

  private static var environment: [String: String] { ProcessInfo.processInfo.environment }
}

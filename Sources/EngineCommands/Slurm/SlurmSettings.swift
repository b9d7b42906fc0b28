/// How the jobs of a plan are submitted, whoever does it: `slurm/settings.json`.
struct SlurmSettings: Codable, Equatable, Sendable {
  /// How many times a chunk is made again unless the user says otherwise. Chosen.
  static let usualRetries = 2

  /// Options of `sbatch` for every job.
  var options: [String]
  /// How many times a chunk is made again after a transient failure.
  var retries: Int
  /// The largest number of processors of a job.
  var maximumThreads: Int
  /// The memory of the largest machine; nil if it is not known.
  var maximumMegabytes: Int?
  /// The program on all machines.
  var program: String
}

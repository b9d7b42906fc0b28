/// Chunks that were submitted as one job array: a file in the folder of the plan.
struct SlurmSubmission: Codable, Equatable, Sendable {
  /// Slurm's ID of the job array.
  var job: String
  var stage: String
  /// The numbers of the chunks.
  var numbers: [Int]
  /// What each of them was given.
  var resources: Resources
  /// Counts the submissions of the plan.
  var order: Int

  /// What a job may use.
  struct Resources: Codable, Hashable, Sendable {
    var threads: Int
    var memoryMegabytes: Int
    var minutes: Int
  }
}

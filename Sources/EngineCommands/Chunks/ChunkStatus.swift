import Foundation
import SharedCommands

/// How the last attempt at a chunk ended: a file in the folder of the plan.
struct ChunkStatus: Codable, Equatable, Sendable {
  /// Of the chunk that was made: a status of other work doesn't count.
  var fingerprint: String
  /// Done, failed or canceled.
  var status: DatasetStatus
  /// The machine that it ran on.
  var node: String
  /// The scheduler's name of the job, if there is one.
  var job: String?
  /// The duration of all attempts so far.
  var seconds = 0.0
  var attempts = 0
  /// Why it failed, with the remedy.
  var error: String?
  /// Whether another attempt may succeed.
  var isTransient = false
  /// Whether another attempt needs more memory.
  var isShortOfMemory = false
  /// The last event of the run.
  var result: RunEvent?
  /// What its user should know.
  var warnings: [String] = []
  /// The events about the files that were written for the user.
  var written: [RunEvent] = []
  /// What was made.
  var outputs: [ChunkOutput] = []
}

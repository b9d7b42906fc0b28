import SharedCommands

/// How far a chunk is that is being made: a file that is replaced every few seconds.
struct ChunkProgress: Codable, Equatable, Sendable {
  var fingerprint: String
  var node: String
  var job: String?
  /// Counts the writes, so that an observer sees that the process is alive, whatever the clocks.
  var count = 0
  /// Share of the chunk that is done, 0…1.
  var fraction = 0.0
  var stage: RunStage?
}

import SharedCommands

/// How far a chunk is that is being made: a file that is replaced every few seconds.
struct ChunkProgress: Codable, Equatable, Sendable {
  var fingerprint: String
  var node: String
  var job: String?
  /// Share of the chunk that is done, 0…1.
  var fraction = 0.0
  var stage: RunStage?
}

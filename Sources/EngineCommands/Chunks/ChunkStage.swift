/// Chunks that don't need each other's results.
struct ChunkStage: Codable, Equatable, Sendable {
  /// A word, part of file names.
  var name: String
  /// Numbered from 1.
  var chunks: [Chunk]
  /// Whether the work is worth something without some of the chunks.
  var isPartial = false

  /// In the order of their numbers.
  var ids: [ChunkID] { chunks.indices.map { ChunkID(stage: name, number: $0 + 1) } }
}

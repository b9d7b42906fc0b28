import Kernels
import Pipeline
import SceneModel

/// A run or a batch as chunks: pieces of work that separate processes make, on any machine that
/// sees the same folders.
///
/// The content of `plan.json`. A chunk is a command of this program with all its arguments; it may
/// be made several times, or at the same time in several places, with the same result.
struct ChunkPlan: Codable, Equatable, Sendable {
  /// Grows when readers of older plans would misunderstand newer ones.
  static let currentFormat = 1

  var format = Self.currentFormat
  /// The build of the program that must make all chunks: others may give other results.
  var program = Self.thisProgram
  /// In the order of work: each stage needs the results of all those before it.
  var stages: [ChunkStage]

  /// The build of this process.
  static var thisProgram: String {
    "\(ProgramVersion.current), build \(ProgramIdentity.fingerprint.hexadecimalDigits)"
  }

  /// The stage of a name.
  func stage(_ name: String) -> ChunkStage? { stages.first { $0.name == name } }

  /// The chunk with an ID.
  subscript(id: ChunkID) -> Chunk? {
    guard let stage = stage(id.stage), stage.chunks.indices.contains(id.number - 1) else {
      return nil
    }
    return stage.chunks[id.number - 1]
  }

  /// The chunks whose files are what the work is for; the others' files are for these only.
  var results: [ChunkID] {
    stages.flatMap { stage in zip(stage.ids, stage.chunks).filter { !$1.areSealed }.map(\.0) }
  }

  /// The number of chunks of all stages.
  var count: Int { stages.reduce(0) { $0 + $1.chunks.count } }
}

/// A piece of work: a command with what it reads and makes.
struct Chunk: Codable, Equatable, Sendable {
  /// For messages: what it makes.
  var name: String
  /// The arguments of this program, without the number of threads.
  var arguments: [String]
  /// The folder that relative paths among them start from.
  var directory: String
  /// The files and folders that it reads.
  var reads: [String]
  /// The files and folders that it makes.
  var writes: [String]
  /// Whether the program that reads these files finds out itself if one is damaged, and makes it
  /// again.
  var areSealed = false
  /// A folder that it resumes from, and that is removed when the chunk is done.
  var scratch: String?
  /// Identifies everything that the result depends on.
  var fingerprint: String
  /// The usual time with `threads` threads.
  var expectedSeconds: Double
  /// How many threads it makes good use of.
  var threads: Int
  /// The usual upper bound of the memory.
  var memoryBytes: Int
}

/// The place of a chunk in its plan.
struct ChunkID: Hashable, Codable, Sendable, CustomStringConvertible {
  /// The name of the stage.
  var stage: String
  /// From 1.
  var number: Int

  /// Such as `views-0003`: the start of file names.
  var description: String {
    let digits = String(number)
    return "\(stage)-" + String(repeating: "0", count: max(0, 4 - digits.count)) + digits
  }
}

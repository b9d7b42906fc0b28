/// The result of a run in one sentence.
package struct RunVerdict: Hashable, Codable, Sendable {
  package enum Level: String, Codable, Sendable {
    case good, fair, poor
    /// There is no model.
    case failed
    /// Nothing was made yet that could be judged.
    case unknown
  }

  package var level: Level
  package var sentence: String
}

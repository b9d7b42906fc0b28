/// How sensitive feature detection is to weak texture.
package enum FeatureSensitivity: String, CaseIterable, Hashable, Codable, Sendable {
  /// For objects with enough texture.
  case normal
  /// For objects with little texture; takes longer.
  case high
}

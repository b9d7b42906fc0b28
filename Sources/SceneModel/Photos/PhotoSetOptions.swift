/// Whether the order of the photos carries information.
package enum SampleOrdering: String, CaseIterable, Hashable, Codable, Sendable {
  /// Any photo may overlap any other.
  case unordered
  /// Photos are in the order of capture, and consecutive ones overlap.
  case sequential
}

/// How sensitive feature detection is to weak texture.
package enum FeatureSensitivity: String, CaseIterable, Hashable, Codable, Sendable {
  /// For objects with enough texture.
  case normal
  /// For objects with little texture; takes longer.
  case high
}

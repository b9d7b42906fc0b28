/// Whether the order of the photos carries information.
package enum SampleOrdering: String, CaseIterable, Hashable, Codable, Sendable {
  /// Any photo may overlap any other.
  case unordered
  /// Photos are in the order of capture, and consecutive ones overlap.
  case sequential
}

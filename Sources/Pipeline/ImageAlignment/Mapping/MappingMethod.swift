/// The structure-from-motion method.
package enum MappingMethod: String, CaseIterable, Hashable, Codable, Sendable {
  /// Global if the view graph is strong enough, incremental otherwise.
  case automatic
  /// One photo at a time.
  case incremental
  /// All photos at once; the ones that are missed are then added one at a time.
  case global
}

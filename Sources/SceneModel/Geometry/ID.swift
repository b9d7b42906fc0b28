/// A typed index into the array of all `Entity` values of a run.
///
/// IDs are dense from 0 in sorted path order: `array[id.index]` looks up the entity, and a loop
/// over `array.indices` is deterministic.
package struct ID<Entity>: Hashable, Comparable, Codable, Sendable {
  package var rawValue: Int32

  @inlinable package init(_ index: Int) { rawValue = Int32(index) }

  /// The index of the entity in its array.
  @inlinable package var index: Int { Int(rawValue) }

  @inlinable package static func < (lhs: Self, rhs: Self) -> Bool { lhs.rawValue < rhs.rawValue }

  @inlinable package static func == (lhs: Self, rhs: Self) -> Bool { lhs.rawValue == rhs.rawValue }

  @inlinable package func hash(into hasher: inout Hasher) { hasher.combine(rawValue) }
}

/// What links two photos or groups of photos.
struct PlacementLink: Hashable, Sendable {
  /// Positive if they show the object in the same placement, negative if they don't.
  var agreement = 0
  /// Number of matches.
  var matches = 0

  static func += (sum: inout Self, other: Self) {
    sum.agreement += other.agreement
    sum.matches += other.matches
  }
}

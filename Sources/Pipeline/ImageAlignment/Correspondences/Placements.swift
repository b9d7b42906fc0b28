/// Groups of photos between which the object was moved.
struct Placements: Hashable, Sendable {
  /// What divided the photos.
  enum Basis: String, Hashable, Sendable {
    /// Nothing: the object was not moved, as far as the photos show.
    case none
    /// The order of the photos, by name: each placement is an interval of it.
    case order
    /// What pairs of photos show, because no division of their order explains it.
    case links
  }

  /// Each in ascending order, larger ones first; one group if the object was not moved.
  var groups: [[Int]]
  var basis: Basis

  init(groups: [[Int]], basis: Basis) {
    self.groups = groups.sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
    self.basis = basis
  }

  /// Whether the object was moved.
  var areSeveral: Bool { groups.count > 1 }

  /// A sentence on what divided the photos; nil if nothing did.
  var explanation: String? {
    let counts = groups.map { String($0.count) }.joined(separator: ", ")
    return switch basis {
    case .none: nil
    case .order:
      "The photos show \(groups.count) placements of the object (\(counts) photos), divided by the "
        + "order of their names."
    case .links:
      "The photos show \(groups.count) placements of the object (\(counts) photos), divided by "
        + "what pairs of them show: the order of their names does not explain it."
    }
  }
}

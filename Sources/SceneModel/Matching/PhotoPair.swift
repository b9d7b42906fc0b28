/// An unordered pair of photos, `first < second`.
package struct PhotoPair: Hashable, Comparable, Codable, Sendable {
  package let first: ID<Photo>
  package let second: ID<Photo>

  /// Sorts the two photos.
  package init(_ a: ID<Photo>, _ b: ID<Photo>) {
    (first, second) = a < b ? (a, b) : (b, a)
  }

  package static func < (lhs: Self, rhs: Self) -> Bool {
    (lhs.first, lhs.second) < (rhs.first, rhs.second)
  }
}

/// A pair of photos that failed verification: too few matches, or too few that agree.
package struct RejectedPair: Hashable, Sendable {
  package var pair: PhotoPair
  /// Number of matches that agree with one two-view geometry.
  package var matches: Int
  /// Number of matches that would have sufficed.
  package var needed: Int
  /// The pair with its geometry, if its matches are too few but agree beyond chance.
  package var weak: VerifiedPair?

  package init(pair: PhotoPair, matches: Int, needed: Int, weak: VerifiedPair? = nil) {
    (self.pair, self.matches, self.needed, self.weak) = (pair, matches, needed, weak)
  }
}

/// The photos and the verified pairs between them, sorted by pair.
package struct ViewGraph: Sendable {
  package var photoCount: Int
  package var pairs: [VerifiedPair]
  /// Pairs with some matches that could not be verified, sorted by pair.
  package var rejected: [RejectedPair]
  /// Pairs between which two bodies moved differently, sorted by pair; empty if the scene is rigid.
  package var motions: [TwoMotions] = []
  /// Whether the object moves in front of its surroundings, whose matches are left out.
  package var omitsSurroundings = false
  /// If so, whether each feature belongs to the surroundings, by photo.
  package var surroundings: [[Bool]] = []
  /// Groups of photos between which the object was moved; empty if it was not, or between most
  /// photos.
  package var placements: [[Int]] = []

  /// The number of matches of all pairs.
  package var matchCount: Int { pairs.reduce(0) { $0 + $1.matches.count } }

  package init(photoCount: Int, pairs: [VerifiedPair], rejected: [RejectedPair] = []) {
    self.photoCount = photoCount
    self.pairs = pairs
    self.rejected = rejected
  }
}

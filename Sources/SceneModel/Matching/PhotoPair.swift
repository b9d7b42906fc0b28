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

/// A match of feature `first` in the pair's first photo with feature `second` in its second photo.
package struct FeatureMatch: Hashable, Codable, Sendable {
  package var first: Int32
  package var second: Int32

  package init(first: Int32, second: Int32) {
    self.first = first
    self.second = second
  }
}

/// A pair of photos whose matches agree with one two-view geometry.
package struct VerifiedPair: Hashable, Sendable {
  /// The model that explains the matches.
  package enum Model: String, Hashable, Codable, Sendable {
    /// An essential matrix (calibrated) or fundamental matrix (uncalibrated), with parallax.
    case essential, fundamental
    /// A homography explains them equally well: a planar scene or a pure rotation.
    case homography
  }

  package var pair: PhotoPair
  package var model: Model
  /// `secondFromFirst` with a unit translation; nil if it can't be determined.
  package var secondFromFirst: RigidTransform?
  /// The inliers, sorted by `first`.
  package var matches: [FeatureMatch]
  /// Median triangulation angle of the inliers in radians; 0 if unknown.
  package var medianAngle: Double

  package init(
    pair: PhotoPair, model: Model, secondFromFirst: RigidTransform?, matches: [FeatureMatch],
    medianAngle: Double
  ) {
    self.pair = pair
    self.model = model
    self.secondFromFirst = secondFromFirst
    self.matches = matches
    self.medianAngle = medianAngle
  }
}

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

/// Two photos between which two bodies moved differently: the object and its surroundings.
///
/// If an object was turned or laid on another side between two photos, the matches on it and those
/// around it agree with two different relative poses.
package struct TwoMotions: Sendable {
  package var pair: PhotoPair
  /// The matches of each body, sorted by `first`, and its relative pose.
  package var bodies: [VerifiedPair]
  /// Whether the first body is at the same pixels of both photos: what a camera on a tripod sees
  /// behind a turntable.
  package var isFirstStatic: Bool

  package init(pair: PhotoPair, bodies: [VerifiedPair], isFirstStatic: Bool) {
    (self.pair, self.bodies, self.isFirstStatic) = (pair, bodies, isFirstStatic)
  }
}

/// The photos and the verified pairs between them, sorted by pair.
package struct ViewGraph: Sendable {
  package var photoCount: Int
  package var pairs: [VerifiedPair]
  /// Pairs with some matches that could not be verified, sorted by pair.
  package var rejected: [RejectedPair]
  /// Pairs between which two bodies moved differently, sorted by pair; empty if the scene is rigid.
  package var motions: [TwoMotions] = []
  /// Whether the object moves in front of its surroundings, whose matches are left out.
  package var isObjectOnly = false
  /// If so, whether each feature belongs to the surroundings, by photo.
  package var surroundings: [[Bool]] = []
  /// Groups of photos between which the object was moved; empty if it was not, or between most
  /// photos.
  package var placements: [[Int]] = []

  package init(photoCount: Int, pairs: [VerifiedPair], rejected: [RejectedPair] = []) {
    self.photoCount = photoCount
    self.pairs = pairs
    self.rejected = rejected
  }
}

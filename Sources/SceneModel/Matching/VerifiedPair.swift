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

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

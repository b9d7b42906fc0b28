import SceneModel

/// A visibility hypothesis: the points of photo `other` that `photo` should show if both poses are
/// correct, and the points that it demonstrably shows.
struct VisibilityHypothesis: Sendable {
  var other: Int
  var photo: Int
  var points: [ExpectedPoint] = []
  /// Pixels in `photo` of points that are matched features of both photos.
  var confirmedPixels: [SIMD2<Double>] = []
}

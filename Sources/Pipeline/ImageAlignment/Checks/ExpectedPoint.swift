import SceneModel

/// A point of one photo that another photo is expected to show.
struct ExpectedPoint: Sendable {
  /// The track of the point.
  var track: Int32
  /// The point and its template in the first photo.
  var reference: TrackReference
  /// The expected position in the other photo, in pixels, and the local affine warp of the
  /// template.
  var pixel: SIMD2<Double>
  var warp: SIMD4<Double>
}

import SceneModel

/// A point of the result, the point of the reference that corresponds to it, and their distance in
/// units of the reference.
struct ClosestPair: Sendable {
  var source: SIMD3<Double>
  var target: SIMD3<Double>
  /// The normal of the reference at the target.
  var normal: SIMD3<Double>
  var distance: Float
}

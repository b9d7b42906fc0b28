/// The light and the surface seen along a ray.
struct Sight {
  /// Linear RGB.
  var radiance: SIMD3<Float>
  /// Infinite for the background.
  var depth = Float.infinity
  var normal = SIMD3<Float>.zero
  /// −1 for the background.
  var surface = -1
  var isLit = false

  /// The index of the transient occluder, which is not a surface of the scene.
  static let intruder = Int.max
}

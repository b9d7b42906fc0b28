/// A point of a surface.
struct SurfaceSample: Hashable, Sendable {
  var position: SIMD3<Float>
  /// Of unit length, in the orientation of the triangle.
  var normal: SIMD3<Double>
}

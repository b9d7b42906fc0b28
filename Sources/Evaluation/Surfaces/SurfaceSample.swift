/// A point of a surface.
struct SurfaceSample: Hashable, Sendable {
  var position: SIMD3<Float>
  /// Of any length, in the orientation of the triangle.
  var normal: SIMD3<Float>
}

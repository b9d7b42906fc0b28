/// A sparse point in a view: pixel position and inverse depth.
package struct PatchSeed: Hashable, Sendable {
  /// Pixel coordinates, origin at the top-left corner of the view.
  package var pixel: SIMD2<Float>
  /// 1 / z in the camera frame.
  package var inverseDepth: Float

  package init(pixel: SIMD2<Float>, inverseDepth: Float) {
    self.pixel = pixel
    self.inverseDepth = inverseDepth
  }
}

import SceneModel

/// A view that may color a triangle. Compact: there are millions.
struct RatedView: Sendable {
  var view: Int32
  /// Larger is better, comparable only within a triangle.
  var quality: Float
  /// Projected area in pixels.
  var area: Float
  /// Cosine of the angle between the triangle's normal and the direction to the camera.
  var cosine: Float
  /// A vector of three would take the memory of four.
  private var red: Float
  private var green: Float
  private var blue: Float

  init(view: Int32, quality: Float, area: Float, cosine: Float, color: SIMD3<Float>) {
    (self.view, self.quality, self.area, self.cosine) = (view, quality, area, cosine)
    (red, green, blue) = (color.x, color.y, color.z)
  }

  /// The exposure-compensated mean color, 0…255.
  var color: SIMD3<Float> { SIMD3(red, green, blue) }
}

/// Views with exposure-compensated colors that may color each triangle.
struct RatedViews: Sendable {
  var views: FaceViews
  /// By entry of `views`; larger is better, comparable only within a triangle.
  var qualities: [Float]
  /// The consensus color of a triangle's views, 0…255; nil if none sees it.
  var colors: [SIMD3<Float>?]
}

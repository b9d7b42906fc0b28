import SceneModel

/// The views that may color each triangle.
struct RatedViews: Sendable {
  /// Ascending by view.
  var views: FaceEntries<RatedView>
  /// The consensus color of a triangle's views, 0…255; nil if none sees it.
  var colors: [SIMD3<Float>?]

  /// A view of a triangle; nil if it may not color the triangle.
  func view(_ view: Int32, of face: Int) -> RatedView? {
    views.entries(of: face).first { $0.view == view }
  }
}

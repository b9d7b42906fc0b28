import SceneModel

/// The points of a dense cloud by view, read one view at a time.
struct FusedViews: Sendable {
  let count: Int
  /// The points of a view.
  let points: @Sendable (_ view: Int) throws -> PointCloud
}

import SceneModel

/// The points of a dense cloud by view, read one view at a time.
struct FusedViews {
  let count: Int
  /// The points of a view.
  let points: (_ view: Int) throws -> PointCloud
}

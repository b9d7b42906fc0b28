import SceneModel

/// What lies around tiles: it limits how far their surfaces reach, hides them from photos, and
/// relates the photos' exposures.
struct TileSurroundings {
  /// Of all that the photos observe, what proves that the space in front of it is free.
  var observed: PointCloud
  /// The surface of the whole scene, of few triangles.
  var occluders: Mesh
  /// The gains of the photos on that surface.
  var gains: [ExposureGain]
}

import SceneModel

/// What lies around tiles: it limits how far their surfaces reach, hides them from photos, and
/// relates the photos' exposures.
struct TileSurroundings {
  /// Of all that the photos observe, what proves that the space in front of it is free.
  let observed: PointCloud
  /// The surface of the whole scene, of few triangles.
  let occluders: Mesh
  /// The gains of the photos on that surface, by photo.
  let gains: [ExposureGain]

  init(observed: PointCloud, _ record: OccluderRecord) {
    self.observed = observed
    (occluders, gains) = (record.mesh, record.gains)
  }
}

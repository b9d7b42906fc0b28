import SceneModel

/// The photos with the masks of the object, and their reconstruction.
struct ObjectScene: Sendable {
  var photos: PhotoSet
  var reconstruction: Reconstruction
  /// What the object stands on, if its masks were estimated.
  var support: SupportPlane?
  /// Coarse points of the surroundings, if masks were estimated.
  var surroundings = PointCloud()

  /// The photos as they are.
  init(_ photos: PhotoSet, _ reconstruction: Reconstruction) {
    (self.photos, self.reconstruction) = (photos, reconstruction)
  }

  /// The photos with estimated masks.
  init(_ photos: PhotoSet, _ reconstruction: Reconstruction, _ estimated: EstimatedMasks) {
    self.init(photos.masked(by: estimated.masks), reconstruction)
    support = estimated.support
    surroundings = estimated.surroundings
    for index in self.reconstruction.photos.indices {
      self.reconstruction.photos[index].mask = estimated.masks[index]
    }
  }
}

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
    self.init(photos, reconstruction, masks: estimated.masks)
    support = estimated.support
    surroundings = estimated.surroundings
  }

  /// The photos with masks, by photo ID.
  init(_ photos: PhotoSet, _ reconstruction: Reconstruction, masks: [PhotoMask?]) {
    self.init(photos.masked(by: masks), reconstruction)
    for index in self.reconstruction.photos.indices {
      self.reconstruction.photos[index].mask = masks[index]
    }
  }
}

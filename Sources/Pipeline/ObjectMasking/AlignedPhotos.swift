import SceneModel

/// The result of alignment.
struct AlignedPhotos: Sendable {
  var reconstruction: Reconstruction
  /// The masks of an object that was moved between photos, which alignment estimated; nil if it
  /// was not moved.
  var masks: EstimatedMasks?
}

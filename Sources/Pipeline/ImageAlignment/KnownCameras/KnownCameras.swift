import SceneModel

/// Cameras and poses that were found elsewhere, by the names of their photos.
///
/// Cameras are for photos turned upright by their EXIF orientation, as `align` writes them; those for
/// photos as they are stored, which COLMAP makes, are turned where their size tells.
package struct KnownCameras: Sendable {
  /// Its photos have a name, a camera and a pose, and nothing else that counts. Its points may be
  /// none.
  package var reconstruction: Reconstruction
  /// The photos whose cameras don't tell for which size they are: they are for that of the photo.
  package var sizeless: Set<ID<Photo>>

  package init(_ reconstruction: Reconstruction, sizeless: Set<ID<Photo>> = []) {
    (self.reconstruction, self.sizeless) = (reconstruction, sizeless)
  }
}

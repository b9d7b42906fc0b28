import SceneModel

/// Externally estimated cameras and poses, identified by the names of their photos.
///
/// Cameras refer to photos rotated upright by their EXIF orientation, as `align` writes them.
/// Cameras of photos in stored orientation, as COLMAP estimates them, are rotated if their size
/// reveals it.
package struct KnownCameras: Sendable {
  /// Only the names, cameras and poses of its photos are used, and its points, which may be empty.
  package var reconstruction: Reconstruction
  /// The photos whose cameras don't state an image size; it is taken from the photo.
  package var photosOfUnknownSize: Set<ID<Photo>>

  package init(_ reconstruction: Reconstruction, photosOfUnknownSize: Set<ID<Photo>> = []) {
    (self.reconstruction, self.photosOfUnknownSize) = (reconstruction, photosOfUnknownSize)
  }
}

/// A photo freed from lens distortion, with its camera and pose: what dense stages work on.
package struct PinholeView: Sendable {
  package var photo: ID<Photo>
  /// RGB, at the size of `camera`.
  package var image: RasterImage
  /// Has no distortion.
  package var camera: Camera
  package var cameraFromWorld: RigidTransform
  /// Gray, of the image's size: 255 where it shows the object, 0 beside it; nil where nothing tells.
  package var mask: RasterImage?

  package init(
    photo: ID<Photo>, image: RasterImage, camera: Camera, cameraFromWorld: RigidTransform,
    mask: RasterImage? = nil
  ) {
    self.photo = photo
    self.image = image
    self.camera = camera
    self.cameraFromWorld = cameraFromWorld
    self.mask = mask
  }
}

/// An undistorted photo with its camera and pose: the input of the dense stages.
package struct PinholeView: Sendable {
  package var photo: ID<Photo>
  /// RGB, at the size of `camera`.
  package var image: RasterImage
  /// Pinhole camera without distortion.
  package var camera: Camera
  /// Pose of the photo.
  package var cameraFromWorld: RigidTransform
  /// Gray, of the image's size: 255 on the object, 0 outside; nil without a mask.
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

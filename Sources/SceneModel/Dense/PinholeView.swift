/// A photo freed from lens distortion, with its camera and pose: what dense stages work on.
package struct PinholeView: Sendable {
  package var photo: ID<Photo>
  /// RGB, at the size of `camera`.
  package var image: RasterImage
  /// Has no distortion.
  package var camera: Camera
  package var cameraFromWorld: RigidTransform

  package init(
    photo: ID<Photo>, image: RasterImage, camera: Camera, cameraFromWorld: RigidTransform
  ) {
    self.photo = photo
    self.image = image
    self.camera = camera
    self.cameraFromWorld = cameraFromWorld
  }
}

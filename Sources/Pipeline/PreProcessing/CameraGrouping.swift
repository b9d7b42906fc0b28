import SceneModel

/// Assigns the same camera to photos with the same body, lens, zoom setting and size.
///
/// Photos rotated by 90° or upside down get a separate camera, because the principal point rotates
/// with the photo. Photos without metadata share one camera per size: sets mostly come from one
/// camera.
package struct CameraGrouping: Sendable {
  private struct Key: Hashable {
    var make: String?
    var model: String?
    var lens: String?
    var serialNumbers: [String?]
    var focalLength: Double?
    var focalLengthIn35mmFilm: Double?
    var orientation: Int
    var width: Int
    var height: Int
  }

  /// Estimates the focal length of each camera.
  package var focalLength: FocalLengthEstimation

  /// Groups photos, with initial focal lengths from `focalLength`.
  package init(_ focalLength: FocalLengthEstimation = FocalLengthEstimation()) {
    self.focalLength = focalLength
  }

  /// Returns the cameras in order of their first photo, and the camera ID of each photo.
  package func run(_ photos: [InspectedPhoto]) -> (cameras: [Camera], ids: [ID<Camera>]) {
    var cameras: [Camera] = []
    var idsByKey: [Key: ID<Camera>] = [:]
    let ids = photos.map { photo in
      let key = Self.key(photo)
      if let id = idsByKey[key] { return id }
      let (pixels, calibration) = focalLength.run(
        photo.metadata, width: photo.width, height: photo.height)
      let id = ID<Camera>(cameras.count)
      cameras.append(
        Camera(
          width: photo.width, height: photo.height, focalLength: SIMD2(repeating: pixels),
          calibration: calibration))
      idsByKey[key] = id
      return id
    }
    return (cameras, ids)
  }

  private static func key(_ photo: InspectedPhoto) -> Key {
    let metadata = photo.metadata
    return Key(
      make: metadata.make, model: metadata.model, lens: metadata.lens,
      serialNumbers: [metadata.bodySerialNumber, metadata.lensSerialNumber],
      focalLength: metadata.focalLength, focalLengthIn35mmFilm: metadata.focalLengthIn35mmFilm,
      orientation: metadata.orientation, width: photo.width, height: photo.height)
  }
}

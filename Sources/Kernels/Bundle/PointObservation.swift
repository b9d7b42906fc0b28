import CKernels

/// An observation of a point in a photo.
package struct PointObservation: Hashable, Sendable {
  /// Index of the photo.
  package var photo: Int32
  /// Index of the point, or of the track.
  package var point: Int32
  /// Pixels of the upright photo, origin at the top-left corner.
  package var pixel: SIMD2<Double>

  package init(photo: Int32, point: Int32, pixel: SIMD2<Double>) {
    self.photo = photo
    self.point = point
    self.pixel = pixel
  }

  var raw: ck_observation {
    ck_observation(photo: photo, point: point, x: pixel.x, y: pixel.y)
  }
}

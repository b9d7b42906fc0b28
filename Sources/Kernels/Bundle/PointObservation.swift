import CKernels

/// An observation of a point in a photo.
package struct PointObservation: Hashable, Sendable {
  /// Index of the photo.
  package var photo: Int32
  /// Index of the point, or of the track.
  package var point: Int32
  /// Pixels of the upright photo, origin at the top-left corner.
  package var pixel: SIMD2<Double>
  /// How precise it is, relative to the others.
  package var whitening: Whitening

  package init(
    photo: Int32, point: Int32, pixel: SIMD2<Double>, whitening: Whitening = .identity
  ) {
    self.photo = photo
    self.point = point
    self.pixel = pixel
    self.whitening = whitening
  }

  var raw: ck_observation {
    ck_observation(
      photo: photo, point: point, x: pixel.x, y: pixel.y, xx: whitening.xx, xy: whitening.xy,
      yy: whitening.yy)
  }
}

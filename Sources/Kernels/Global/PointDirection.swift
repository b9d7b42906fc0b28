/// The direction, in the world frame, in which a photo observes a point.
package struct PointDirection: Hashable, Sendable {
  /// Index of the photo.
  package var photo: Int32
  /// Index of the point.
  package var point: Int32
  /// A unit vector.
  package var direction: SIMD3<Double>

  package init(photo: Int32, point: Int32, direction: SIMD3<Double>) {
    (self.photo, self.point, self.direction) = (photo, point, direction)
  }
}

import SceneModel

/// A measured relative rotation of two photos: `R_second = rotation · R_first`.
package struct RelativeRotation: Hashable, Sendable {
  /// Index of the first photo.
  package var first: Int32
  /// Index of the second photo.
  package var second: Int32
  /// Rotates the first camera frame to the second.
  package var rotation: Quaternion
  /// Confidence, positive.
  package var weight: Double

  package init(first: Int32, second: Int32, rotation: Quaternion, weight: Double = 1) {
    (self.first, self.second, self.rotation, self.weight) = (first, second, rotation, weight)
  }
}

/// A triangulated point and its observations.
package struct ScenePoint: Hashable, Codable, Sendable {
  /// In the world frame.
  package var position: SIMD3<Double>
  /// RGB.
  package var color: SIMD3<UInt8>
  /// Mean reprojection error in pixels.
  package var error: Double
  /// Sorted by photo; at most one observation per photo.
  package var track: [Observation]

  package init(
    position: SIMD3<Double>, color: SIMD3<UInt8> = .zero, error: Double = 0,
    track: [Observation] = []
  ) {
    self.position = position
    self.color = color
    self.error = error
    self.track = track
  }
}

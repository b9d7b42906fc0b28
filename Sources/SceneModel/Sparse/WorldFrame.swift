/// The sources of the scale and the up direction of the world frame.
package struct WorldFrame: Hashable, Codable, Sendable {
  /// The source of the scale.
  package enum Scale: String, Hashable, Codable, Sendable {
    /// Depth maps, GPS, distances measured by the user, or none of them.
    case depth, gps, knownDistance, arbitrary
    /// The cameras were given, and their unit was declared to be the meter.
    case given

    /// Whether lengths are in meters.
    package var isMetric: Bool { self != .arbitrary }
  }
  /// The source of the up direction.
  package enum Up: String, Hashable, Codable, Sendable {
    case gravity, gps, supportPlane, cameras, unknown
    /// The user named the side of the photos that was up.
    case chosen
    /// An object that was moved: that of its largest group of photos without a move.
    case placement
  }

  package var scale: Scale
  package var up: Up
  /// The direction opposite to gravity when the photos were taken, if the user had the object
  /// turned so that it isn't +y.
  package var turnedVertical: SIMD3<Double>?
  /// The direction opposite to gravity when the photos were taken.
  package var vertical: SIMD3<Double> { turnedVertical ?? [0, 1, 0] }

  package init(scale: Scale = .arbitrary, up: Up = .unknown) {
    self.scale = scale
    self.up = up
  }
}

import SceneModel

extension WorldAlignment {
  package struct Options: Hashable, Codable, Sendable {
    /// Measured distances; they take precedence over depth maps and GPS.
    package var knownDistances: [KnownDistance] = []
    /// Gravity and depth by sample ID; they also take precedence over GPS.
    package var readings: [Int: SensorReading] = [:]
    /// Expected error of a GPS position in meters.
    package var gpsNoise = 5.0
    /// Minimum spread of the positions, as a multiple of their error.
    package var gpsSpreadFactor = 3.0
    /// GPS determines the up direction if its expected error is below this number of degrees.
    package var gpsTiltDegrees = 3.0
    /// Maximum distance of a point from the support plane, relative to the cameras' distance from
    /// the object.
    package var planeThickness = 0.01
    /// Minimum fraction of the points near the object on an unambiguous support plane.
    package var planeShare = 0.12
    /// Minimum fraction if the plane stands out as a layer.
    package var minimumPlaneShare = 0.03
    /// Maximum angle in degrees between the support plane's normal and the cameras' mean up
    /// direction.
    package var planeTiltDegrees = 30.0
    /// Whether to search for a support plane. If masks exclude the support, any plane would belong
    /// to the object.
    package var findsSupport = true
    package var seed: UInt64 = 1

    package init() {}
  }
}

import SceneModel

extension WorldAlignment {
  package struct Options: Hashable, Codable, Sendable {
    /// Measured distances; they take precedence over depth maps and GPS.
    package var knownDistances: [KnownDistance] = []
    /// Gravity and depth by sample ID; they also take precedence over GPS.
    package var readings: [Int: SensorReading] = [:]
    /// The up direction that the user chose; it takes precedence over all others.
    package var chosenUp: ChosenUp?
    var gravity = GravityUp.Options()
    var depthMaps = DepthMapScale.Options()
    var cameraUp = CameraUp.Options()
    var widerEnd = WiderEndUp.Options()
    /// Expected error of a GPS position in meters. Chosen.
    package var gpsNoise = 5.0
    /// Minimum spread of the positions, as a multiple of their error. Chosen.
    package var gpsSpreadFactor = 3.0
    /// GPS determines the up direction if its expected error is below this number of degrees.
    /// Chosen.
    package var gpsTiltDegrees = 3.0
    /// Minimum vertical error that is assumed, as a share of `gpsNoise`: few positions may agree by
    /// chance. Chosen.
    package var gpsMinimumVerticalShare = 0.2
    /// Error limit of an inlier as a multiple of `gpsNoise`. Chosen.
    package var gpsInlierFactor = 3.0
    /// Number of RANSAC hypotheses, positions per hypothesis, and fits to the inliers. Chosen.
    package var gpsIterations = 300
    package var gpsSampleSize = 4
    package var gpsRefinements = 3
    /// Maximum distance of a point from the support plane, relative to the cameras' distance from
    /// the object. Chosen.
    package var planeThickness = 0.01
    /// Minimum fraction of the points near the object on an unambiguous support plane. Chosen.
    package var planeShare = 0.12
    /// Minimum fraction if the plane stands out as a layer. Chosen.
    package var minimumPlaneShare = 0.03
    /// Maximum angle in degrees between the support plane's normal and the cameras' mean up
    /// direction. Chosen.
    package var planeTiltDegrees = 30.0
    /// Whether to search for a support plane. If masks exclude the support, any plane would belong
    /// to the object.
    package var findsSupport = true
    /// Minimum cosine of the angle between the support plane's normal and the final up direction at
    /// which the plane is the ground. Chosen: 16°.
    package var groundCosine = 0.96
    /// Without such a plane, one in this number of the object's points is below the ground. Chosen.
    package var groundDivisor = 50
    /// Seed of the random samples for GPS and for the support plane. Chosen: any value serves.
    package var seed: UInt64 = 1

    package init() {}
  }
}

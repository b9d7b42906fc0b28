extension IncrementalMapping {
  package struct Options: Hashable, Codable, Sendable {
    /// Requirements on the initial pair, in matches and median triangulation angle; levels are
    /// tried in this order. Chosen: the first level is COLMAP's default.
    package var initialPairLevels = [
      InitialPairLevel(matches: 100, angleDegrees: 16),
      InitialPairLevel(matches: 50, angleDegrees: 8),
      InitialPairLevel(matches: 30, angleDegrees: 4),
      InitialPairLevel(matches: 15, angleDegrees: 2),
    ]
    /// Maximum number of initial pairs tried per group of photos. Chosen.
    package var initialPairTrials = 12
    /// Factor on the score of a pair that a homography explains equally well: a plane or a pure
    /// rotation leaves the relative pose ambiguous. Chosen.
    package var planarPairWeight = 0.3
    /// Maximum reprojection error of the initial pair's first points, as a multiple of
    /// `growthError`. Chosen.
    package var initialErrorFactor = 2.0
    /// Minimum number of points of an initial pair. Chosen.
    package var minimumInitialPoints = 8
    /// Maximum number of restarts from another initial pair if less than half of the connected
    /// photos were registered. Chosen.
    package var restarts = 2
    /// Minimum number of inlier points to register a photo, and after no other photo can be
    /// registered. Chosen: the first is COLMAP's default, too.
    package var minimumInliers = 30
    package var relaxedMinimumInliers = 12
    /// Minimum fraction of inliers among the observed points. Chosen: COLMAP's default, too.
    package var minimumInlierRatio = 0.25
    /// Maximum number of attempts to register a photo, before and again after the requirements are
    /// relaxed. Chosen: COLMAP's default, too.
    package var registrationTrials = 3
    /// Maximum reprojection error in pixels for the registration of a photo. Chosen.
    package var resectionError = 10.0
    /// Maximum reprojection error of an observation in pixels while the map grows. Chosen: COLMAP's
    /// default, too.
    package var growthError = 4.0
    /// Maximum reprojection error, as a multiple of `growthError`, of the points of a photo whose
    /// pose was estimated without points. Chosen.
    package var structurelessErrorFactor = 4.0
    /// Maximum reprojection error of an observation in pixels at the end. Chosen.
    package var finalError = 3.0
    /// Minimum triangulation angle of a point in degrees. Chosen: COLMAP's default, too.
    package var minimumAngleDegrees = 1.5
    /// Growth factor of photos or points that triggers a global adjustment. Chosen: COLMAP's
    /// default, too.
    package var globalGrowth = 1.1
    /// Maximum number of global adjustments at the end. Chosen.
    package var finalRounds = 4
    /// The global adjustments at the end stop when less than one in this number of observations
    /// changes. Chosen.
    package var finalChangeDivisor = 1000
    var structurelessPose = StructurelessPose.Options()
    var adjustment = MapAdjustment.Options()
    /// Minimum number of observations that keep a photo registered. Chosen.
    package var minimumObservations = 10

    package init() {}

    /// Minimum number of matches and minimum median triangulation angle, in degrees, of an initial
    /// pair.
    package struct InitialPairLevel: Hashable, Codable, Sendable {
      package var matches: Int
      package var angleDegrees: Double

      package init(matches: Int, angleDegrees: Double) {
        self.matches = matches
        self.angleDegrees = angleDegrees
      }
    }
  }
}

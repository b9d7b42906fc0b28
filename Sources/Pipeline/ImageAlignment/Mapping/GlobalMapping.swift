import Kernels
import SceneModel

/// Global structure from motion: rotation averaging over the pairs, then global positioning of
/// cameras and points from their viewing directions, then bundle adjustment (Pan et al., "Global
/// structure-from-motion revisited", ECCV 2024).
///
/// Photos that the global start misses are registered one at a time afterwards, as in incremental
/// mapping.
package struct GlobalMapping: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Minimum number of matches of a pair whose rotation is used. Chosen.
    package var minimumMatches = 30
    /// Maximum distance from the epipolar line, as a fraction of the photo's longer side, in pairs
    /// that were verified without focal lengths: a wrong focal length causes errors of a few
    /// pixels. Chosen.
    package var relativeMaximumError = 0.003
    /// Maximum rotation of a consistent triplet's loop, in degrees. Chosen.
    package var tripletErrorDegrees = 5.0
    /// Minimum fraction of its triplets in which a pair must be consistent. Chosen.
    package var tripletShare = 0.2
    /// Pairs that deviate from the averaged rotations by more than this, in degrees, are dropped.
    /// Chosen: the default of GLOMAP (Pan et al. 2024), too.
    package var rotationErrorDegrees = 10.0
    /// Maximum number of averaging rounds; each drops the pairs that the previous result
    /// contradicts. Chosen.
    package var rotationRounds = 3
    package var averaging = RotationAveraging.Options()
    /// Minimum number of photos that observe a track used for positioning. Chosen: GLOMAP's
    /// default, too.
    package var minimumTrackLength = 3
    /// Number of tracks used for positioning that each photo observes, if available. Chosen.
    package var pointsPerPhoto = 100
    package var positioning = GlobalPositioning.Options()
    /// Maximum angle in degrees between an observation and the direction to its point after
    /// positioning. Chosen.
    package var positionErrorDegrees = 3.0
    /// Maximum reprojection errors in the first adjustments, as multiples of `growthError`. Chosen.
    package var errorFactors = [4.0, 1.0]
    /// Minimum fraction of the points it observes that a photo must agree with. Chosen.
    package var minimumPhotoShare = 0.4
    /// Median triangulation angle in radians beyond which a pair's points aren't any better
    /// conditioned. Chosen.
    package var saturationAngle = 0.3
    /// Half the side of the cube of random initial positions of global positioning; its unit is
    /// arbitrary. Chosen: GLOMAP's value.
    package var initialHalfExtent = 100.0
    /// Seed of these positions. Chosen: any value serves.
    package var seed: UInt64 = 1

    package init() {}
  }

  package var options: Options
  /// Options of the incremental completion of the global start.
  package var growth: IncrementalMapping.Options

  package init(
    _ options: Options = Options(),
    growth: IncrementalMapping.Options = IncrementalMapping.Options()
  ) {
    (self.options, self.growth) = (options, growth)
  }

  /// Returns an initial map of all photos whose rotations and positions the pairs determine; nil
  /// for fewer than three photos. `empty` holds the tracks.
  func start(
    _ graph: ViewGraph, features: [FeatureSet], _ empty: SparseMap, _ context: StageContext
  ) throws -> SparseMap? {
    do {
      let relative = try relativeRotations(
        graph, features, empty.photos, context.part(from: 0, to: 0.1))
      guard let rotations = try rotations(relative, context.part(from: 0.1, to: 0.2)) else {
        return nil
      }
      var map = empty
      guard try position(&map, rotations, context.part(from: 0.2, to: 0.6)) else { return nil }
      fixGauge(&map, graph)
      try refine(&map, context.part(from: 0.6, to: 1))
      // The photos that define the gauge may have been removed.
      fixGauge(&map, graph)
      return map.registered.count >= 3 ? map : nil
    } catch let error as KernelError where error != .outOfMemory {
      // The data doesn't determine one of the steps.
      return nil
    }
  }
}

import Kernels
import SceneModel

/// Incremental structure from motion: grows a reconstruction from one pair of photos, one photo at
/// a time (Snavely et al., "Photo tourism", 2006; Schönberger and Frahm, "Structure-from-motion
/// revisited", CVPR 2016).
package struct IncrementalMapping: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Requirements on the initial pair, in matches and median triangulation angle; levels are
    /// tried in this order.
    package var initialPairLevels = [
      InitialPairLevel(matches: 100, angleDegrees: 16),
      InitialPairLevel(matches: 50, angleDegrees: 8),
      InitialPairLevel(matches: 30, angleDegrees: 4),
      InitialPairLevel(matches: 15, angleDegrees: 2),
    ]
    /// Maximum number of initial pairs tried per group of photos.
    package var initialPairTrials = 12
    /// Maximum number of restarts from another initial pair if less than half of the connected
    /// photos were registered.
    package var restarts = 2
    /// Minimum number of inlier points to register a photo, and after no other photo can be
    /// registered.
    package var minimumInliers = 30
    package var relaxedMinimumInliers = 12
    /// Minimum fraction of inliers among the observed points.
    package var minimumInlierRatio = 0.25
    /// Maximum reprojection error in pixels for the registration of a photo.
    package var resectionError = 10.0
    /// Maximum reprojection error of an observation in pixels while the map grows.
    package var growthError = 4.0
    /// Maximum reprojection error of an observation in pixels at the end.
    package var finalError = 3.0
    /// Minimum triangulation angle of a point in degrees.
    package var minimumAngleDegrees = 1.5
    /// Growth factor of photos or points that triggers a global adjustment.
    package var globalGrowth = 1.1
    /// Maximum number of global adjustments at the end.
    package var finalRounds = 4
    /// Minimum number of observations that keep a photo registered.
    package var minimumObservations = 10

    package init() {}
  }

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

  package var options: Options
  var adjustment = MapAdjustment.Options()

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the largest reconstruction of the view graph, grown from `empty`, which holds the
  /// tracks, and from `start` if given; otherwise in the frame of its first photo, with the
  /// baseline of the initial pair as unit. `unregistered` gives the reasons why photos are missing.
  func run(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], empty: SparseMap,
    from start: SparseMap?, _ context: StageContext
  ) throws -> Reconstruction {
    let growth = MapGrowth(
      mapping: self, graph: graph, photos: photos, empty: empty, context: context)
    let maps = try growth.run(from: start)
    context.notes.record("components", Double(maps.count))
    var best = maps.first ?? growth.empty
    if best.registered.isEmpty { best = growth.empty }
    return reconstruction(best, others: Array(maps.dropFirst()), graph, features, photos)
  }

  private func reconstruction(
    _ map: SparseMap, others: [SparseMap], _ graph: ViewGraph, _ features: [FeatureSet],
    _ photos: [Photo]
  ) -> Reconstruction {
    var cameras = map.photos.cameras
    for photo in map.registered {
      cameras[Int(map.photos.cameraOfPhoto[photo])].calibration = .refined
    }
    let points = (0..<map.tracks.count).filter { map.isTriangulated[$0] }.map { track in
      map.scenePoint(track, features)
    }
    return Reconstruction(
      cameras: cameras, photos: photos, poses: map.photos.poses, points: points,
      unregistered: unregistered(map, others: others, graph, features, photos))
  }
}

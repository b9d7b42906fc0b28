import Kernels
import SceneModel

/// Grows a reconstruction from one pair of photos, one photo at a time (Snavely et al., "Photo
/// tourism", 2006; Schönberger and Frahm, "Structure-from-motion revisited", CVPR 2016).
package struct IncrementalMapping: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Matches and median angle in degrees that the first pair needs; the first row that a pair
    /// fulfils decides.
    package var initialPairLevels = [
      InitialPairLevel(matches: 100, angleDegrees: 16),
      InitialPairLevel(matches: 50, angleDegrees: 8),
      InitialPairLevel(matches: 30, angleDegrees: 4),
      InitialPairLevel(matches: 15, angleDegrees: 2),
    ]
    /// First pairs tried before a group of photos is given up.
    package var initialPairTrials = 12
    /// Other first pairs tried when less than half of the connected photos came in.
    package var restarts = 2
    /// Points that a photo must agree with to be registered, and when nothing else is left.
    package var minimumInliers = 30
    package var relaxedMinimumInliers = 12
    /// Share of the points seen that must agree.
    package var minimumInlierRatio = 0.25
    /// Largest reprojection error in pixels while a photo is registered.
    package var resectionError = 10.0
    /// Largest reprojection error of an observation in pixels while the map grows.
    package var growthError = 4.0
    /// Largest reprojection error of an observation in pixels at the end.
    package var finalError = 3.0
    /// Smallest angle of a point in degrees.
    package var minimumAngleDegrees = 1.5
    /// Growth of photos or points after which all is adjusted.
    package var globalGrowth = 1.1
    /// Adjustments of everything at the end, at most.
    package var finalRounds = 4
    /// Observations that keep a photo registered.
    package var minimumObservations = 10

    package init() {}
  }

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

  /// The largest reconstruction that the view graph gives, grown from `empty`, which holds the tracks,
  /// and from `start` where there is one, else in the frame of its first photo and the unit of its
  /// first pair; `unregistered` says why photos are missing.
  func run(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], empty: SparseMap,
    from start: SparseMap?, _ context: StageContext
  ) throws -> Reconstruction {
    let growth = MapGrowth(
      mapping: self, graph: graph, photos: photos, empty: empty, context: context)
    let maps = try growth.run(from: start)
    context.notes.count("components", Double(maps.count))
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

import Kernels
import SceneModel

/// Reconstructs all photos at once: rotations from the pairs' rotations, then the places of cameras and
/// points from their directions, then bundle adjustment (Pan et al., "Global structure-from-motion
/// revisited", ECCV 2024).
///
/// Photos that the start misses are registered one by one afterwards, as incremental mapping does.
package struct GlobalMapping: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Matches of a pair whose rotation counts.
    package var minimumMatches = 30
    /// Largest rotation around three photos whose pairs agree, in degrees.
    package var tripletErrorDegrees = 5.0
    /// Share of its triplets that a pair has to agree with.
    package var tripletShare = 0.2
    /// A pair that is off by more than this from the average, in degrees, is dropped.
    package var rotationErrorDegrees = 10.0
    /// Averages at most, each without the pairs that the one before contradicts.
    package var rotationRounds = 3
    package var averaging = RotationAveraging.Options()
    /// Photos that see a point used for positions.
    package var minimumTrackLength = 3
    /// Points used for positions that each photo sees, if there are as many.
    package var pointsPerPhoto = 100
    package var positioning = GlobalPositioning.Options()
    /// Largest angle in degrees between an observation and its point after positioning.
    package var positionErrorDegrees = 3.0
    /// Largest reprojection errors in the first adjustments, in units of that of growth.
    package var errorFactors = [4.0, 1.0]
    /// Share of the points it sees that a photo has to agree with.
    package var minimumPhotoShare = 0.4
    /// Seed of the random places that positioning starts with.
    package var seed: UInt64 = 1

    package init() {}
  }

  package var options: Options
  /// How the start is completed and finished.
  package var growth: IncrementalMapping.Options
  var adjustment = MapAdjustment.Options()

  package init(
    _ options: Options = Options(),
    growth: IncrementalMapping.Options = IncrementalMapping.Options()
  ) {
    (self.options, self.growth) = (options, growth)
  }

  /// A map of all photos whose rotations and places the pairs determine, to grow from; nil for less
  /// than three. `empty` has the tracks.
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
      anchor(&map, graph)
      try refine(&map, context.part(from: 0.6, to: 1))
      // The photos that held the world may be gone.
      anchor(&map, graph)
      return map.registered.count >= 3 ? map : nil
    } catch let error as KernelError where error != .outOfMemory {
      // The data doesn't determine one of the steps.
      return nil
    }
  }
}

import Kernels
import SceneModel

/// Triangulates sparse points for photos with known cameras and poses: features are matched,
/// verified against the epipolar geometry of the poses, linked to tracks and triangulated. Poses
/// and cameras stay unchanged.
package struct KnownPoseTriangulation: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    package var features = FeatureExtraction.Options()
    package var selection = PairSelection.Options()
    package var matching = FeatureMatching.Options()
    package var guided = EpipolarMatching()
    /// Maximum distance from the epipolar line, and then maximum reprojection error, as a fraction
    /// of the photo's longer side.
    package var relativeMaximumError = PairVerification.Options().relativeMaximumError
    /// Pairs with fewer matches consistent with the poses are dropped. Chosen.
    package var minimumMatches = 12
    /// Maximum reprojection error as a multiple of the median, which reflects the accuracy of the
    /// cameras. Chosen.
    package var maximumErrorFactor = 3.0
    /// Error in pixels that is attributed to feature localization; the error limit is never lower.
    /// Chosen.
    package var featureError = 1.0
    /// Minimum triangulation angle of a point in degrees. Chosen: as in `IncrementalMapping`.
    package var minimumAngleDegrees = 1.5
    /// Fraction of matches consistent with the cameras below which a warning is issued. Chosen.
    package var suspiciousAgreement = 0.4
    /// Fraction below which the cameras are rejected: close to what chance matches reach. Chosen.
    package var minimumAgreement = 0.15

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the reconstruction with new points. Throws `PipelineError.camerasDontFit` if there are
  /// none or too few matches agree with the cameras.
  package func run(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    let features = try features(of: reconstruction, images, context.part(from: 0, to: 0.5))
    let graph = try viewGraph(reconstruction, features, context.part(from: 0.5, to: 0.9))
    let tracks = try TrackBuilding().run(
      graph, features: features, context.part(from: 0.9, to: 0.95))
    let map = try triangulate(tracks, reconstruction, context.part(from: 0.95, to: 1))
    var result = reconstruction
    result.points = try map.scenePoints(features, context.control)
    guard !result.points.isEmpty else {
      throw PipelineError.camerasDontFit(
        reason: "no point was found at which matching features of two photos meet.")
    }
    context.notes.record("meanReprojectionError", result.meanReprojectionError)
    return result
  }

  /// The features of the photos that have a pose, by photo ID.
  private func features(
    of reconstruction: Reconstruction, _ images: ImageStore, _ context: StageContext
  ) throws -> [FeatureSet] {
    let photos = reconstruction.registered
    let found = try FeatureExtraction(options.features)
      .run(photos.map { reconstruction.photos[$0.index] }, images: images, context)
    var features = reconstruction.photos.map { _ in FeatureSet() }
    for (photo, set) in zip(photos, found) { features[photo.index] = set }
    return features
  }

  /// The pairs of photos with the matches that are consistent with the poses.
  private func viewGraph(
    _ reconstruction: Reconstruction, _ features: [FeatureSet], _ context: StageContext
  ) throws -> ViewGraph {
    let pairs = try PairSelection(options.selection)
      .run(features, ordering: .unordered, context.part(from: 0, to: 0.1)).pairs
    let matches = try FeatureMatching(options.matching)
      .run(pairs, features: features, context.part(from: 0.1, to: 0.8))
    let points = try context.control.parallelMap(features.count) { photo in
      reconstruction.camera(of: ID(photo)).normalizedPositions(of: features[photo])
    }
    let verified = try context.part(from: 0.8, to: 1).control.parallelMap(pairs.count) { index in
      try verify(pairs[index], matches[index], reconstruction, features, points)
    }
    let graph = ViewGraph(
      photoCount: features.count,
      pairs: verified.compactMap(\.pair).sorted { $0.pair < $1.pair })
    let all = matches.filter { $0.count >= options.minimumMatches }.reduce(0) { $0 + $1.count }
    try report(graph, all, agreeing: verified.reduce(0) { $0 + $1.agreeing }, context.notes)
    return graph
  }

  /// Keeps and counts the matches that are consistent with the poses and adds matches along the
  /// epipolar lines; nil if too few are consistent.
  private func verify(
    _ pair: PhotoPair, _ matches: [FeatureMatch], _ reconstruction: Reconstruction,
    _ features: [FeatureSet], _ points: [[SIMD2<Double>]]
  ) throws -> (pair: VerifiedPair?, agreeing: Int) {
    let (first, second) = (pair.first.index, pair.second.index)
    guard let secondFromFirst = direction(pair, reconstruction) else { return (nil, 0) }
    let essential = secondFromFirst.essentialMatrix
    let limit = maximumError(
      reconstruction.camera(of: pair.first), reconstruction.camera(of: pair.second))
    var agreeing = matches.filter {
      essential.sampsonError(points[first][Int($0.first)], points[second][Int($0.second)]) <= limit
    }
    let count = agreeing.count
    guard count >= options.minimumMatches else { return (nil, 0) }
    var matching = options.guided
    matching.maximumError = limit
    agreeing += try matching.matches(
      .init(features[first], points: points[first], except: agreeing.map(\.first)),
      .init(features[second], points: points[second], except: agreeing.map(\.second)),
      matrix: essential, KernelControl())
    let verified = VerifiedPair(
      pair: pair, model: .essential, secondFromFirst: secondFromFirst,
      matches: agreeing.sorted { $0.first < $1.first }, medianAngle: 0)
    return (verified, count)
  }

  /// `secondFromFirst` of a pair, with a unit translation; nil if both photos share one center, so
  /// that nothing can be triangulated.
  private func direction(
    _ pair: PhotoPair, _ reconstruction: Reconstruction
  ) -> RigidTransform? {
    guard let first = reconstruction.poses[pair.first.index],
      let second = reconstruction.poses[pair.second.index]
    else { return nil }
    var secondFromFirst = second * first.inverse
    let length = secondFromFirst.translation.length
    guard length > 0, length.isFinite else { return nil }
    secondFromFirst.translation = secondFromFirst.translation.normalized
    return secondFromFirst
  }

  /// The error limit in normalized image coordinates (depth 1), the mean over both photos.
  private func maximumError(_ first: Camera, _ second: Camera) -> Double {
    options.relativeMaximumError * (first.normalizedSide + second.normalizedSide) / 2
  }

  /// Records the metrics, and warns or throws if too few of `all` matches agree with the cameras.
  private func report(
    _ graph: ViewGraph, _ all: Int, agreeing: Int, _ notes: StageNotes
  ) throws {
    let verified = graph.matchCount
    notes.record("matches", Double(all))
    notes.record("consistentMatches", Double(agreeing))
    notes.record("verifiedPairs", Double(graph.pairs.count))
    notes.record("verifiedMatches", Double(verified))
    let agreement = Double(agreeing) / Double(max(1, all))
    let sentence =
      "only \(Int(100 * agreement)) % of the feature matches between two photos agree with the "
      + "cameras"
    guard all == 0 || agreement >= options.minimumAgreement else {
      throw PipelineError.camerasDontFit(reason: sentence + ".")
    }
    if all > 0, agreement < options.suspiciousAgreement {
      notes.warn("The cameras may not be those of these photos: \(sentence).")
    }
  }

  /// Triangulates the tracks with fixed poses and removes inconsistent observations.
  private func triangulate(
    _ tracks: FeatureTracks, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> SparseMap {
    var map = SparseMap(
      cameras: reconstruction.cameras, photos: reconstruction.photos, tracks: tracks)
    for photo in reconstruction.registered {
      if let pose = reconstruction.poses[photo.index] { map.register(photo.index, pose) }
    }
    let sides = reconstruction.registered.map { photo in
      reconstruction.camera(of: photo).longerSide
    }
    let side = sides.upperMedian ?? 0
    var step = PointTriangulation()
    step.options.minimumAngleDegrees = options.minimumAngleDegrees
    step.options.maximumError = max(
      options.featureError, options.relativeMaximumError * side)
    let control = context.control
    try step.triangulate(Array(0..<map.tracks.count), in: &map, control)
    // Tracks that merge two similar points are split into both.
    map.splitTracks()
    try step.triangulate(Array(0..<map.tracks.count), in: &map, control)
    let median = try map.medianError(control)
    step.options.maximumError = min(
      step.options.maximumError, max(options.featureError, options.maximumErrorFactor * median))
    try step.filter(Array(0..<map.tracks.count), in: &map, control)
    return map
  }
}

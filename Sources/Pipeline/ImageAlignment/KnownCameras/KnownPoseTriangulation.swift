import Kernels
import SceneModel

/// Sparse points for photos whose cameras and poses are known: features are matched, the epipolar
/// geometry of the poses says which matches are right, and tracks are triangulated from where the
/// photos stand. No pose and no camera changes.
package struct KnownPoseTriangulation: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    package var features = FeatureExtraction.Options()
    package var selection = PairSelection.Options()
    package var matching = FeatureMatching.Options()
    package var guided = EpipolarMatching()
    /// Largest distance from the epipolar line, and then largest error of reprojection, as a fraction
    /// of the photo's longer side.
    package var relativeMaximumError = 0.0012
    /// Pairs with fewer matches that agree with the poses are dropped.
    package var minimumMatches = 12
    /// Points may be off by so many times the median error of reprojection, which shows how exact the
    /// cameras are.
    package var maximumErrorFactor = 3.0
    /// Errors below this number of pixels are those of features.
    package var featureError = 1.0
    /// Smallest angle in degrees between two rays of a point.
    package var minimumAngleDegrees = 1.5
    /// Share of matches that agree with the cameras below which these are suspected, in a warning.
    package var suspiciousAgreement = 0.4
    /// And below which they are refused: by chance hardly more agree.
    package var minimumAgreement = 0.15

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The reconstruction with new points; throws `PipelineError.camerasDontFit` where there are none.
  package func run(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    let features = try features(of: reconstruction, images, context.part(from: 0, to: 0.5))
    let graph = try viewGraph(reconstruction, features, context.part(from: 0.5, to: 0.9))
    let tracks = try TrackBuilding().run(
      graph, features: features, context.part(from: 0.9, to: 0.95))
    let map = try triangulate(tracks, reconstruction, context.part(from: 0.95, to: 1))
    var result = reconstruction
    result.points = (0..<map.tracks.count).filter { map.isTriangulated[$0] }
      .map { map.scenePoint($0, features) }
    guard !result.points.isEmpty else {
      throw PipelineError.camerasDontFit(
        reason: "no point was found at which matching features of two photos meet.")
    }
    context.notes.count("meanReprojectionError", result.meanReprojectionError)
    return result
  }

  /// The features of the photos that have a pose, by photo id.
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

  /// The pairs of photos with the matches that agree with the poses.
  private func viewGraph(
    _ reconstruction: Reconstruction, _ features: [FeatureSet], _ context: StageContext
  ) throws -> ViewGraph {
    let pairs = try PairSelection(options.selection)
      .run(features, isSequential: false, context.part(from: 0, to: 0.1)).pairs
    let matches = try FeatureMatching(options.matching)
      .run(pairs, features: features, context.part(from: 0.1, to: 0.8))
    let points = try context.control.parallelMap(features.count) { photo in
      let camera = reconstruction.camera(of: ID(photo))
      return features[photo].positions.map { camera.unproject(SIMD2<Double>($0)) }
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

  /// Keeps the matches that agree with the poses, counts them, and looks along the epipolar lines for
  /// more; no pair where few agree.
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

  /// `secondFromFirst` of a pair with a translation of unit length; nil where both photos were taken
  /// from one place, from which nothing can be triangulated.
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

  /// The largest error at depth 1, the mean of the two photos'.
  private func maximumError(_ first: Camera, _ second: Camera) -> Double {
    let sizes = [first, second].map {
      Double(max($0.width, $0.height)) * 2 / $0.focalLength.sum()
    }
    return options.relativeMaximumError * (sizes[0] + sizes[1]) / 2
  }

  /// Notes the figures, and warns or throws where few of `all` matches agree with the cameras.
  private func report(
    _ graph: ViewGraph, _ all: Int, agreeing: Int, _ notes: StageNotes
  ) throws {
    let verified = graph.pairs.reduce(0) { $0 + $1.matches.count }
    notes.count("matches", Double(all))
    notes.count("matchesThatAgree", Double(agreeing))
    notes.count("verifiedPairs", Double(graph.pairs.count))
    notes.count("verifiedMatches", Double(verified))
    let agreement = Double(agreeing) / Double(max(1, all))
    let sentence =
      "only \(Int(100 * agreement)) % of the features that look alike in two photos agree with the "
      + "cameras"
    guard all == 0 || agreement >= options.minimumAgreement else {
      throw PipelineError.camerasDontFit(reason: sentence + ".")
    }
    if all > 0, agreement < options.suspiciousAgreement {
      notes.warn("The cameras may not be those of these photos: \(sentence).")
    }
  }

  /// Triangulates the tracks with the poses as they are and takes off what disagrees.
  private func triangulate(
    _ tracks: FeatureTracks, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> SparseMap {
    var map = SparseMap(
      cameras: reconstruction.cameras, photos: reconstruction.photos, tracks: tracks)
    for photo in reconstruction.registered {
      if let pose = reconstruction.poses[photo.index] { map.register(photo.index, pose) }
    }
    let sides = reconstruction.registered.map { photo in
      Double(max(reconstruction.camera(of: photo).width, reconstruction.camera(of: photo).height))
    }.sorted()
    let side = sides.isEmpty ? 0 : sides[sides.count / 2]
    var step = PointTriangulation()
    step.options.minimumAngleDegrees = options.minimumAngleDegrees
    step.options.maximumError = max(
      options.featureError, options.relativeMaximumError * side)
    let control = context.control
    try step.triangulate(Array(0..<map.tracks.count), in: &map, control)
    // Tracks of two points that look alike give both.
    map.splitTracks()
    try step.triangulate(Array(0..<map.tracks.count), in: &map, control)
    let median = try map.medianError(control)
    step.options.maximumError = min(
      step.options.maximumError, max(options.featureError, options.maximumErrorFactor * median))
    try step.filter(Array(0..<map.tracks.count), in: &map, control)
    return map
  }
}

extension Matrix3 {
  /// How far two points at depth 1 are from agreeing with this essential matrix, to first order
  /// (Sampson): about the distance that they would have to move.
  fileprivate func sampsonError(_ first: SIMD2<Double>, _ second: SIMD2<Double>) -> Double {
    let (a, b) = (SIMD3(first, 1), SIMD3(second, 1))
    let line = SIMD3(row0.dot(a), row1.dot(a), row2.dot(a))
    let x = row0.x * b.x + row1.x * b.y + row2.x * b.z
    let y = row0.y * b.x + row1.y * b.y + row2.y * b.z
    let square = line.x * line.x + line.y * line.y + x * x + y * y
    return square > 0 ? abs(b.dot(line)) / square.squareRoot() : .infinity
  }
}

import Kernels
import SceneModel

/// Geometric verification: keeps the matches of a pair that agree with one two-view geometry, by
/// LO-RANSAC with the five-point solver (Nistér, PAMI 2004), or the seven-point solver if no focal
/// length is known.
package struct PairVerification {
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum distance from the epipolar line, as a fraction of the photo's longer side. Chosen.
    package var relativeMaximumError = 0.0012
    /// A pair with fewer inliers is dropped. Chosen.
    package var minimumInliers = 20
    /// A pair with a smaller fraction of inliers among its matches is dropped. Chosen.
    package var minimumInlierRatio = 0.15
    /// A weak pair has fewer inliers, but at least this number and this fraction: too few to rely
    /// on, and too many for chance. Measured: all 183 such pairs in ten captures of seed 23 agree
    /// with the true geometry (docs/experiments/2026-11-moving-objects.md).
    package var weakMinimumInliers = 12
    package var weakMinimumInlierRatio = 0.5
    /// Probability that RANSAC finds the best model. Chosen.
    package var confidence = 0.9999
    /// Maximum number of RANSAC iterations. Chosen: too few for 70 % outliers, where 2 to 6 % of
    /// the pairs fail (docs/experiments/2026-11-libraries.md).
    package var maximumIterations = 1000
    /// Fraction of inliers explained by a homography from which on the pair counts as planar.
    /// Chosen.
    package var homographyRatio = 0.8
    /// Combined with the photos' IDs for the random samples of each pair. Chosen: any value serves.
    package var seed: UInt64 = 0

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the verified pairs of `pairs`, sorted. `matches` has the matches of each pair, the
  /// best first.
  package func run(
    _ pairs: [PhotoPair], matches: [[FeatureMatch]], features: [FeatureSet], photos: [Photo],
    cameras: [Camera], _ context: StageContext
  ) throws -> ViewGraph {
    ViewGraph(
      photoCount: photos.count,
      try verdicts(
        pairs, matches: matches, features: features, photos: photos, cameras: cameras, context))
  }

  /// Returns the verdict on each of `pairs`; needs the features of their photos only.
  func verdicts(
    _ pairs: [PhotoPair], matches: [[FeatureMatch]], features: [FeatureSet], photos: [Photo],
    cameras: [Camera], _ context: StageContext
  ) throws -> [Verdict] {
    let isNeeded = Set(pairs.flatMap { [$0.first, $0.second] })
    let points = try context.part(from: 0, to: 0.1).control.parallelMap(photos.count) { index in
      isNeeded.contains(ID(index))
        ? cameras[photos[index].camera.index].normalizedPositions(of: features[index]) : []
    }
    return try context.part(from: 0.1, to: 1).control.parallelMap(pairs.count) { index in
      let pair = pairs[index]
      return try verify(
        pair, matches[index], points: (points[pair.first.index], points[pair.second.index]),
        cameras: (
          cameras[photos[pair.first.index].camera.index],
          cameras[photos[pair.second.index].camera.index]
        ))
    }
  }

  /// The result of verifying a pair.
  enum Verdict: Hashable, Sendable {
    case verified(VerifiedPair)
    case rejected(RejectedPair)
  }

  /// Rejects a pair if no geometry agrees with enough of the matches. `points` are the features of
  /// both photos at depth 1.
  func verify(
    _ pair: PhotoPair, _ matches: [FeatureMatch],
    points: ([SIMD2<Double>], [SIMD2<Double>]), cameras: (Camera, Camera)
  ) throws -> Verdict {
    func rejected(_ inliers: Int, weak: VerifiedPair? = nil) -> Verdict {
      let share = Int((options.minimumInlierRatio * Double(matches.count)).rounded(.up))
      let needed = max(options.minimumInliers, share)
      return .rejected(RejectedPair(pair: pair, matches: inliers, needed: needed, weak: weak))
    }
    guard matches.count >= min(options.minimumInliers, options.weakMinimumInliers) else {
      return rejected(matches.count)
    }
    let isCalibrated = isCalibrated(cameras)
    var estimation = TwoViewEstimation()
    estimation.isCalibrated = isCalibrated
    estimation.maximumError = maximumError(cameras)
    estimation.confidence = options.confidence
    estimation.maximumIterations = options.maximumIterations
    estimation.seed = options.seed &+ UInt64(pair.first.index) << 32 &+ UInt64(pair.second.index)
    // Each task is single-threaded; tasks run in parallel.
    let geometry = try estimation.geometry(
      matches.map { points.0[Int($0.first)] }, matches.map { points.1[Int($0.second)] },
      KernelControl())
    guard let geometry else { return rejected(0) }
    let isPlanar =
      Double(geometry.homographyInlierCount)
      >= options.homographyRatio * Double(geometry.inliers.count)
    let estimated = VerifiedPair(
      pair: pair, model: isPlanar ? .homography : isCalibrated ? .essential : .fundamental,
      secondFromFirst: geometry.secondFromFirst,
      matches: geometry.inliers.map { matches[$0] }.sorted { $0.first < $1.first },
      medianAngle: geometry.medianAngle)
    func has(_ inliers: Int, _ ratio: Double) -> Bool {
      geometry.inliers.count >= inliers
        && Double(geometry.inliers.count) >= ratio * Double(matches.count)
    }
    if has(options.minimumInliers, options.minimumInlierRatio) { return .verified(estimated) }
    let isWeak = has(options.weakMinimumInliers, options.weakMinimumInlierRatio)
    return rejected(geometry.inliers.count, weak: isWeak ? estimated : nil)
  }

  /// Whether the focal lengths are known well enough for an essential matrix.
  func isCalibrated(_ cameras: (Camera, Camera)) -> Bool {
    cameras.0.calibration != .assumed && cameras.1.calibration != .assumed
  }

  /// The error limit in normalized image coordinates (depth 1), the mean over both photos.
  func maximumError(_ cameras: (Camera, Camera)) -> Double {
    options.relativeMaximumError * (cameras.0.normalizedSide + cameras.1.normalizedSide) / 2
  }
}

extension ViewGraph {
  /// The pairs of some verdicts; pairs without matches are left out.
  init(photoCount: Int, _ verdicts: [PairVerification.Verdict]) {
    self.init(photoCount: photoCount, pairs: [])
    add(verdicts)
  }

  /// Adds the pairs of some verdicts, except those without matches.
  mutating func add(_ verdicts: [PairVerification.Verdict]) {
    for verdict in verdicts {
      switch verdict {
      case .verified(let pair): pairs.append(pair)
      case .rejected(let pair): if pair.matches > 0 { rejected.append(pair) }
      }
    }
    pairs.sort { $0.pair < $1.pair }
    rejected.sort { $0.pair < $1.pair }
  }
}

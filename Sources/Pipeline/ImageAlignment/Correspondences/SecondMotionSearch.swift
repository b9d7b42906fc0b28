import Kernels
import SceneModel

/// Finds the pairs of photos that show two rigid motions, by sequential RANSAC: a second geometry
/// is estimated from the matches that contradict the first.
package struct SecondMotionSearch: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Whether to search for second motions.
    package var isEnabled = true
    /// The pairs with the most unexplained matches are examined first, up to this number. If less
    /// than `minimumShare` of them show a second motion, the scene is considered rigid. Measured:
    /// the share was found on captures of seed 7; eleven real sets in which nothing moves have no
    /// such pair (docs/experiments/2026-11-moving-objects.md).
    package var sampleSize = 40
    package var minimumShare = 0.15
    /// Minimum number of matches of each motion. Chosen: as many as a pair needs
    /// (`PairVerification`).
    package var minimumMatches = 20
    /// Minimum fraction of the unexplained matches that must agree with the second motion.
    /// Measured: found on captures of seed 7 (docs/experiments/2026-11-moving-objects.md).
    package var minimumShareOfRest = 0.4
    /// Minimum fraction of the matches of one motion that must contradict the other. Measured: as
    /// above.
    package var minimumDistinctShare = 0.7
    /// The same for static matches: while the camera turns about the object, matches near its
    /// middle are static as well, but agree with the motion of the rest; and in front of a tripod,
    /// some of the background agrees with the motion of a turntable by chance. Measured: as above.
    package var minimumStaticDistinctShare = 0.15
    /// Matches contradict a motion beyond this multiple of the error limit. Chosen.
    package var distinctFactor = 2.0
    /// Displacement up to which matches prove that a camera did not move, as a fraction of the
    /// photo's longer side. Chosen.
    package var staticDisplacement = 0.001
    /// If it did not, matches up to this multiple of that displacement are static: features are
    /// not located exactly. Chosen.
    package var staticTolerance = 4.0
    /// Maximum number of RANSAC iterations. Chosen.
    package var maximumIterations = 500

    package init() {}

    /// The displacement up to which matches are static if the camera did not move, in pixels.
    func staticLimit(_ photo: Photo) -> Float {
      Float(staticTolerance * staticDisplacement * Double(max(photo.width, photo.height)))
    }
  }

  package var options: Options
  package var verification: PairVerification

  package init(_ options: Options, verification: PairVerification) {
    (self.options, self.verification) = (options, verification)
  }

  /// The pairs with two motions, sorted by pair. `matches` has all matches of each of `pairs`, the
  /// best first; `graph` has the first motions.
  func run(
    _ pairs: [PhotoPair], matches: [[FeatureMatch]], graph: ViewGraph, features: [FeatureSet],
    photos: [Photo], cameras: [Camera], _ context: StageContext
  ) throws -> [TwoMotions] {
    guard options.isEnabled else { return [] }
    let points = try context.control.parallelMap(photos.count) { index in
      cameras[photos[index].camera.index].normalizedPositions(of: features[index])
    }
    let known = Dictionary(uniqueKeysWithValues: graph.pairs.map { ($0.pair, $0) })
    let candidates = try context.control.parallelMap(pairs.count) { index in
      candidate(
        pairs[index], matches[index], known[pairs[index]], features, photos)
    }.compactMap { $0 }.sorted { ($1.priority, $0.pair) < ($0.priority, $1.pair) }
    func examine(_ part: ArraySlice<Candidate>, _ control: KernelControl) throws -> [TwoMotions] {
      let part = Array(part)
      return try control.parallelMap(part.count) {
        try motions(part[$0], points, photos, cameras)
      }.compactMap { $0 }
    }
    let sample = candidates.prefix(options.sampleSize)
    let found = try examine(sample, context.control)
    guard !found.isEmpty, Double(found.count) >= options.minimumShare * Double(sample.count) else {
      return []
    }
    return (found + (try examine(candidates.dropFirst(sample.count), context.control)))
      .sorted { $0.pair < $1.pair }
  }

  /// A pair that may show two motions.
  private struct Candidate: Sendable {
    var pair: PhotoPair
    /// The first motion; its pose is nil if it is static.
    var first: VerifiedPair
    var isStatic: Bool
    /// The matches that the first motion doesn't explain.
    var rest: [FeatureMatch]

    var priority: Int { min(first.matches.count, rest.count) }
  }

  private func candidate(
    _ pair: PhotoPair, _ matches: [FeatureMatch], _ known: VerifiedPair?, _ features: [FeatureSet],
    _ photos: [Photo]
  ) -> Candidate? {
    if let still = staticMatches(pair, matches, features, photos) {
      let rest = matches.filter { !still.contains($0) }
      guard rest.count >= options.minimumMatches else { return nil }
      return Candidate(
        pair: pair,
        first: VerifiedPair(
          pair: pair, model: .homography, secondFromFirst: nil,
          matches: still.sorted { $0.first < $1.first }, medianAngle: 0),
        isStatic: true, rest: rest)
    }
    guard let known, known.secondFromFirst != nil else { return nil }
    let explained = Set(known.matches)
    let rest = matches.filter { !explained.contains($0) }
    guard rest.count >= options.minimumMatches else { return nil }
    return Candidate(pair: pair, first: known, isStatic: false, rest: rest)
  }

  /// The matches at the same pixel of both photos, if they prove that the camera did not move.
  private func staticMatches(
    _ pair: PhotoPair, _ matches: [FeatureMatch], _ features: [FeatureSet], _ photos: [Photo]
  ) -> Set<FeatureMatch>? {
    let (a, b) = (photos[pair.first.index], photos[pair.second.index])
    guard a.width == b.width, a.height == b.height else { return nil }
    let limit = Float(options.staticDisplacement * Double(max(a.width, a.height)))
    let shifts = matches.map { features.displacement(of: $0, in: pair) }
    guard shifts.count(where: { $0 <= limit }) >= options.minimumMatches else { return nil }
    let tolerance = options.staticLimit(a)
    return Set(zip(matches, shifts).filter { $0.1 <= tolerance }.map(\.0))
  }

  private func motions(
    _ candidate: Candidate, _ points: [[SIMD2<Double>]], _ photos: [Photo], _ cameras: [Camera]
  ) throws -> TwoMotions? {
    let pair = candidate.pair
    let points = (points[pair.first.index], points[pair.second.index])
    let cameras = (
      cameras[photos[pair.first.index].camera.index],
      cameras[photos[pair.second.index].camera.index]
    )
    var second = verification
    second.options.minimumInliers = options.minimumMatches
    second.options.minimumInlierRatio = options.minimumShareOfRest
    second.options.maximumIterations = options.maximumIterations
    second.options.seed = verification.options.seed &+ 0x9E37_79B9
    guard
      case .verified(let other) = try second.verify(
        pair, candidate.rest, points: points, cameras: cameras),
      let pose = other.secondFromFirst
    else { return nil }
    let judge = MotionComparison(
      points: points, limit: options.distinctFactor * verification.maximumError(cameras),
      minimumShare: candidate.isStatic
        ? options.minimumStaticDistinctShare : options.minimumDistinctShare)
    guard judge.areDistinct(candidate.first.matches, from: pose) else { return nil }
    if let first = candidate.first.secondFromFirst {
      guard judge.areDistinct(other.matches, from: first) else { return nil }
      let seed = second.options.seed &+ UInt64(pair.first.index) << 32 &+ UInt64(pair.second.index)
      guard try !judge.areOne(candidate.first.matches, other.matches, seed: seed) else {
        return nil
      }
    }
    return TwoMotions(
      pair: pair, bodies: [candidate.first, other], isFirstStatic: candidate.isStatic)
  }
}

/// Compares the matches of two motions of a pair of photos.
private struct MotionComparison {
  /// The features of both photos at depth 1.
  let points: ([SIMD2<Double>], [SIMD2<Double>])
  /// The distance from an epipolar line beyond which a match contradicts a motion, at depth 1.
  let limit: Double
  /// Minimum fraction of the matches of one motion that must contradict the other.
  let minimumShare: Double

  /// Whether the matches are of another motion than a pose.
  func areDistinct(_ matches: [FeatureMatch], from pose: RigidTransform) -> Bool {
    contradictingShare(matches, pose) >= minimumShare
  }

  /// Whether one motion explains as much of both as each of two is to explain of its own.
  ///
  /// The motion that was estimated from the matches of a plane may be wrong, and contradict
  /// everything that is not on the plane. The same number of matches of both is taken, so that the
  /// larger motion does not decide.
  func areOne(
    _ first: [FeatureMatch], _ second: [FeatureMatch], seed: UInt64
  ) throws -> Bool {
    let count = min(first.count, second.count)
    let both = (0..<count).flatMap { index in
      [first, second].map { $0[index * $0.count / count] }
    }
    var estimation = TwoViewEstimation()
    estimation.maximumError = limit
    estimation.seed = seed
    let geometry = try estimation.geometry(
      both.map { points.0[Int($0.first)] }, both.map { points.1[Int($0.second)] }, KernelControl())
    guard let pose = geometry?.secondFromFirst else { return false }
    return [first, second].allSatisfy { contradictingShare($0, pose) <= 1 - minimumShare }
  }

  private func contradictingShare(_ matches: [FeatureMatch], _ pose: RigidTransform) -> Double {
    let matrix = pose.essentialMatrix
    let outside = matches.count {
      matrix.sampsonError(points.0[Int($0.first)], points.1[Int($0.second)]) > limit
    }
    return Double(outside) / Double(max(1, matches.count))
  }
}

extension [FeatureSet] {
  /// The distance between the two features of a match in their photos, in pixels.
  func displacement(of match: FeatureMatch, in pair: PhotoPair) -> Float {
    let offset =
      self[pair.second.index].positions[Int(match.second)]
      - self[pair.first.index].positions[Int(match.first)]
    return (offset * offset).sum().squareRoot()
  }
}

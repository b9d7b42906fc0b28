import Foundation
import Kernels
import SceneModel

/// Estimates the focal length of a camera without metadata from the matches between its photos.
///
/// For each candidate focal length, the relative pose of a pair is fitted and the residuals of the
/// matches are summed; the true focal length has the smallest sum. The best candidates of the pairs
/// vote, each weighted by the cost increase of wrong candidates. Unlike with closed forms
/// (Bougnoux, ICCV 1998), pairs whose geometry doesn't determine the focal length have no weight,
/// since their error is the same for all candidates.
package struct SelfCalibration {
  package struct Options: Hashable, Codable, Sendable {
    /// Candidates range from the assumed focal length divided by this to the one multiplied by it.
    /// Measured: tuned on the sets marked so in Benchmarks/sets.json.
    package var range = 2.6
    /// Number of candidates, evenly spaced in their logarithms. Chosen: steps of 8 %.
    package var candidates = 25
    /// Maximum number of pairs used per camera, those with the most matches. Chosen.
    package var maximumPairs = 60
    /// Maximum number of matches used per pair. Chosen.
    package var maximumMatches = 400
    /// Pairs with fewer matches aren't used. Measured: tuned on the sets marked so in
    /// Benchmarks/sets.json.
    package var minimumMatches = 50
    /// The weight of a pair is the rise of its cost this number of candidates away from the best.
    /// Measured: as above.
    package var weightDistance = 4
    /// Fraction of the total weight that must be within `agreement` of the median. Measured: as
    /// above.
    package var minimumAgreement = 0.5
    /// Maximum difference of agreeing focal lengths, as the logarithm of their ratio. Measured: as
    /// above.
    package var agreement = 0.15
    /// Minimum total weight of all votes, in matches that become outliers. Measured: as above.
    package var minimumWeight = 10.0
    /// Error at which the cost saturates, as a fraction of the photo's longer side.
    package var relativeMaximumError = PairVerification.Options().relativeMaximumError

    package init() {}
  }

  /// The matches of a pair, at depth 1 for the assumed focal length.
  private struct PairMatches: Sendable {
    var first: [SIMD2<Double>]
    var second: [SIMD2<Double>]
    var fundamental: Matrix3
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the cameras; assumed focal lengths are improved if the pairs determine them.
  package func run(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], cameras: [Camera],
    _ context: StageContext
  ) throws -> [Camera] {
    var cameras = cameras
    for index in cameras.indices where cameras[index].calibration == .assumed {
      let pairs = usablePairs(of: ID(index), graph, photos)
      if let factor = try factor(cameras[index], pairs, features, context) {
        cameras[index].focalLength *= factor
      }
    }
    return cameras
  }

  private func usablePairs(
    of camera: ID<Camera>, _ graph: ViewGraph, _ photos: [Photo]
  ) -> [VerifiedPair] {
    let pairs = graph.strongestPairs {
      photos[$0.pair.first.index].camera == camera && photos[$0.pair.second.index].camera == camera
        && $0.model != .homography && $0.matches.count >= options.minimumMatches
    }
    return Array(pairs.prefix(options.maximumPairs))
  }

  /// The factor from the assumed to the estimated focal length; nil if the pairs don't determine
  /// it.
  private func factor(
    _ camera: Camera, _ pairs: [VerifiedPair], _ features: [FeatureSet], _ context: StageContext
  ) throws -> Double? {
    let limit =
      options.relativeMaximumError * camera.longerSide
      / camera.focalLength.x
    let usable = try context.control.parallelMap(pairs.count) {
      try matches(of: pairs[$0], camera, features, limit)
    }.compactMap { $0 }
    let steps = options.candidates - 1
    let candidates = (0...steps).map { log(options.range) * (2 * Double($0) / Double(steps) - 1) }
    let factors = candidates.map(exp)
    let costs = try context.control.parallelMap(usable.count) { index in
      let pair = usable[index]
      return try FocalLengthCost.costs(
        pair.first, pair.second, fundamental: pair.fundamental, maximumError: limit,
        factors: factors, KernelControl()
      ).map { $0 / (limit * limit) }
    }
    return agreed(costs.compactMap { vote($0, candidates) }).map(exp)
  }

  /// A pair's vote: the logarithm of the factor, from a parabola through its smallest cost, and its
  /// weight.
  private func vote(_ costs: [Double], _ candidates: [Double]) -> (factor: Double, weight: Double)?
  {
    guard let best = costs.indices.min(by: { costs[$0] < costs[$1] }), best > 0,
      best < costs.count - 1
    else { return nil }
    let (a, b, c) = (costs[best - 1], costs[best], costs[best + 1])
    let curvature = a - 2 * b + c
    let shift = curvature > 0 ? 0.5 * (a - c) / curvature : 0
    let left = costs[max(0, best - options.weightDistance)]
    let right = costs[min(costs.count - 1, best + options.weightDistance)]
    let spacing = candidates[best + 1] - candidates[best]
    return (candidates[best] + shift * spacing, max(0, min(left, right) - b))
  }

  /// The weighted median of the votes; nil if they disagree or weigh too little.
  private func agreed(_ votes: [(factor: Double, weight: Double)]) -> Double? {
    let sorted = votes.sorted { ($0.factor, $0.weight) < ($1.factor, $1.weight) }
    let total = sorted.reduce(0) { $0 + $1.weight }
    var sum = 0.0
    let median = sorted.first {
      sum += $0.weight
      return sum >= total / 2
    }
    guard let median = median?.factor, total >= options.minimumWeight else { return nil }
    let agreeing = sorted.filter { abs($0.factor - median) <= options.agreement }
      .reduce(0) { $0 + $1.weight }
    return agreeing >= options.minimumAgreement * total ? median : nil
  }

  /// The matches of a pair and their fundamental matrix; nil if none fits them. `limit` is the
  /// error at depth 1 at which the cost saturates.
  private func matches(
    of pair: VerifiedPair, _ camera: Camera, _ features: [FeatureSet], _ limit: Double
  ) throws -> PairMatches? {
    let matches = pair.thinnedMatches(options.maximumMatches)
    let first = camera.normalizedPositions(
      of: matches, in: features[pair.pair.first.index], \.first)
    let second = camera.normalizedPositions(
      of: matches, in: features[pair.pair.second.index], \.second)
    var estimation = TwoViewEstimation()
    estimation.isCalibrated = false
    estimation.maximumError = limit
    let geometry = try estimation.geometry(first, second, KernelControl())
    return geometry.map { PairMatches(first: first, second: second, fundamental: $0.matrix) }
  }
}

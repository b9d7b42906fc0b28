import Foundation
import Kernels
import SceneModel

/// Finds the focal length of a camera without metadata from the matches between its photos.
///
/// For each candidate it fits the relative pose of many pairs and adds what the matches are off; true
/// focal lengths leave least. Unlike closed forms (Bougnoux, ICCV 1998) this lets pairs whose geometry
/// doesn't determine the focal length have no say: their error is the same for all candidates.
package struct SelfCalibration {
  package struct Options: Hashable, Codable, Sendable {
    /// Candidates lie between the assumed focal length divided and multiplied by this.
    package var range = 2.6
    /// Candidates of the first pass; the second looks between the neighbours of the best.
    package var candidates = 25
    /// Pairs used at most for each camera, those with the most matches.
    package var maximumPairs = 40
    /// Matches used at most of a pair.
    package var maximumMatches = 400
    /// A pair with fewer matches isn't used.
    package var minimumMatches = 50
    /// Candidates this factor off have to cost more than the best by `minimumRise`.
    package var testFactor = 1.35
    /// Relative rise of the cost.
    package var minimumRise = 1.25
    /// Largest error that counts in full, as a fraction of the photo's longer side.
    package var relativeMaximumError = 0.0012

    package init() {}
  }

  /// The matches of a pair at depth 1 with the assumed focal length.
  private struct Evidence: Sendable {
    var first: [SIMD2<Double>]
    var second: [SIMD2<Double>]
    var fundamental: Matrix3
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The cameras, with a better focal length where it was only assumed and the pairs determine it.
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
    let pairs = graph.pairs.filter {
      photos[$0.pair.first.index].camera == camera && photos[$0.pair.second.index].camera == camera
        && $0.model != .homography && $0.matches.count >= options.minimumMatches
    }
    let sorted = pairs.sorted {
      ($0.matches.count, $1.pair) > ($1.matches.count, $0.pair)
    }
    return Array(sorted.prefix(options.maximumPairs))
  }

  /// By what the focal length has to be multiplied; nil where the pairs don't tell.
  private func factor(
    _ camera: Camera, _ pairs: [VerifiedPair], _ features: [FeatureSet], _ context: StageContext
  ) throws -> Double? {
    let limit =
      options.relativeMaximumError * Double(max(camera.width, camera.height))
      / camera.focalLength.x
    let collected = try context.control.parallelMap(pairs.count) {
      try self.evidence(pairs[$0], camera, features, limit)
    }
    let evidence = collected.compactMap { $0 }
    guard !evidence.isEmpty else { return nil }
    func costs(_ factors: [Double]) throws -> [Double] {
      try cost(evidence, limit, factors, context)
    }
    let steps = options.candidates - 1
    let coarse = (0...steps).map { pow(options.range, 2 * Double($0) / Double(steps) - 1) }
    let coarseCosts = try costs(coarse)
    guard let best = coarse.indices.min(by: { coarseCosts[$0] < coarseCosts[$1] }),
      best > 0, best < steps
    else { return nil }
    let (low, high) = (coarse[best - 1], coarse[best + 1])
    let fine = (0...12).map { low * pow(high / low, Double($0) / 12) }
    let fineCosts = try costs(fine)
    let factor = minimum(fine, fineCosts)
    let sides = try costs([factor, factor / options.testFactor, factor * options.testFactor])
    let isClear = sides.dropFirst().allSatisfy { $0 > options.minimumRise * sides[0] }
    return isClear ? factor : nil
  }

  private func evidence(
    _ pair: VerifiedPair, _ camera: Camera, _ features: [FeatureSet], _ limit: Double
  ) throws -> Evidence? {
    let stride = max(1, pair.matches.count / options.maximumMatches)
    let matches = Swift.stride(from: 0, to: pair.matches.count, by: stride).map { pair.matches[$0] }
    func points(_ photo: ID<Photo>, _ index: (FeatureMatch) -> Int32) -> [SIMD2<Double>] {
      let positions = features[photo.index].positions
      return matches.map { camera.unproject(SIMD2<Double>(positions[Int(index($0))])) }
    }
    let first = points(pair.pair.first) { $0.first }
    let second = points(pair.pair.second) { $0.second }
    var estimation = TwoViewEstimation()
    estimation.isCalibrated = false
    estimation.maximumError = limit
    let geometry = try estimation.geometry(first, second, KernelControl())
    return geometry.map { Evidence(first: first, second: second, fundamental: $0.matrix) }
  }

  private func cost(
    _ evidence: [Evidence], _ limit: Double, _ factors: [Double], _ context: StageContext
  ) throws -> [Double] {
    let costs = try context.control.parallelMap(evidence.count) { index in
      let pair = evidence[index]
      return try FocalLengthCost.costs(
        pair.first, pair.second, fundamental: pair.fundamental, maximumError: limit,
        factors: factors, KernelControl())
    }
    return factors.indices.map { index in costs.reduce(0) { $0 + $1[index] } }
  }

  /// The minimum of the parabola through the smallest of `costs` and its neighbours.
  private func minimum(_ factors: [Double], _ costs: [Double]) -> Double {
    guard let best = factors.indices.min(by: { costs[$0] < costs[$1] }) else { return 1 }
    guard best > 0, best < factors.count - 1 else { return factors[best] }
    let (a, b, c) = (costs[best - 1], costs[best], costs[best + 1])
    let curvature = a - 2 * b + c
    let shift = curvature > 0 ? 0.5 * (a - c) / curvature : 0
    return factors[best] * pow(factors[best + 1] / factors[best], shift)
  }
}

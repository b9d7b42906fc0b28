import Foundation
import Kernels
import SceneModel

/// Per-channel gains of the photos, so that triangles seen by several photos have the same color in
/// all.
///
/// Least squares on logarithms with Huber weights; the triangles' colors are eliminated.
struct ExposureCompensation: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Residuals beyond this, in natural logarithms, are down-weighted. Chosen.
    var huber = 0.1
    /// Number of reweighted solutions. Chosen.
    var rounds = 3
    /// Weight of the prior gain of 1, as a share of the observations' weight. Chosen.
    var prior = 0.02
    /// Gains are limited to 1 / maximum … maximum. Chosen.
    var maximumGain: Float = 2.5
    /// Observations at a smaller cosine (more oblique) are ignored. Chosen.
    var minimumCosine: Float = 0.35
    /// Values of a channel, exclusive, between which the sensor response is linear, 0…255. Chosen.
    var linearRange: ClosedRange<Float> = 6...246
    /// On surfaces with more triangles, every nth is used, so that at least this many remain.
    /// Chosen.
    var sufficientFaces = 200_000
  }

  var options = Options()

  /// One gain per view.
  func run(_ views: FaceViews, viewCount: Int, _ context: StageContext) throws -> [ExposureGain] {
    var logGains = [SIMD3<Double>](repeating: .zero, count: viewCount)
    let step = max(1, views.faceCount / max(1, options.sufficientFaces))
    let faces = stride(from: 0, to: views.faceCount, by: step)
    let pairs = ViewPairs(of: faces, in: views, viewCount: viewCount)
    for round in 0..<options.rounds {
      try context.step(round, of: options.rounds)
      let solutions = try context.part(from: 0, to: 0).control.parallelMap(3) {
        [logGains] channel in
        var system = PairwiseDifferences(of: pairs)
        for face in faces {
          add(face, channel, of: views, logGains, to: &system)
        }
        return try system.solve(prior: options.prior, KernelControl())
      }
      for view in 0..<viewCount {
        logGains[view] = SIMD3(solutions[0][view], solutions[1][view], solutions[2][view])
      }
    }
    let limit = options.maximumGain
    return logGains.map { gain in
      let value = SIMD3<Float>(Float(exp(gain.x)), Float(exp(gain.y)), Float(exp(gain.z)))
      return ExposureGain(
        factors: value.clamped(
          lowerBound: SIMD3(repeating: 1 / limit), upperBound: SIMD3(repeating: limit)))
    }
  }

  /// Adds the robustly weighted log colors of one triangle in one channel.
  private func add(
    _ face: Int, _ channel: Int, of views: FaceViews, _ gains: [SIMD3<Double>],
    to system: inout PairwiseDifferences
  ) {
    var items: [(view: Int, log: Double, weight: Double)] = []
    for entry in views.entries(of: face) {
      let value = entry.color[channel]
      guard entry.cosine >= options.minimumCosine, value > options.linearRange.lowerBound,
        value < options.linearRange.upperBound
      else { continue }
      items.append(
        (Int(entry.view), log(Double(value + ExposureGain.encodingOffset)), Double(entry.cosine)))
    }
    guard items.count >= 2,
      let median = items.map({ $0.log + gains[$0.view][channel] }).upperMedian
    else { return }
    for index in items.indices {
      let residual = abs(items[index].log + gains[items[index].view][channel] - median)
      if residual > options.huber { items[index].weight *= options.huber / residual }
    }
    system.add(items)
  }
}

/// Pairwise differences of views' logarithmic gains in one channel.
private struct PairwiseDifferences {
  private let pairs: ViewPairs
  private var weights: [Double]
  private var sums: [Double]

  init(of pairs: ViewPairs) {
    self.pairs = pairs
    weights = Array(repeating: 0, count: pairs.count)
    sums = weights
  }

  /// Adds `Σ w (log + gain − mean)²` with the weighted mean eliminated, which leaves pairs.
  mutating func add(_ items: [(view: Int, log: Double, weight: Double)]) {
    let total = items.reduce(0) { $0 + $1.weight }
    guard total > 0 else { return }
    for (index, b) in items.enumerated() {
      for a in items[..<index] {
        let weight = a.weight * b.weight / total
        let pair = pairs.index(of: b.view, a.view)
        weights[pair] += weight
        sums[pair] += weight * (a.log - b.log)
      }
    }
  }

  /// The logarithmic gains; `prior` pulls them to 0, relative to a view's mean weight.
  func solve(prior: Double, _ control: KernelControl) throws -> [Double] {
    let count = pairs.viewCount
    let total = weights.reduce(0, +)
    guard total > 0 else { return Array(repeating: 0, count: count) }
    var system = SparseLeastSquares(unknownCount: count)
    for b in 0..<count {
      system.add(b, value: .zero, weight: prior * 2 * total / Double(count))
      for a in pairs.partners(of: b) {
        let pair = pairs.index(of: b, a)
        guard weights[pair] > 0 else { continue }
        let value = sums[pair] / weights[pair]
        system.add(b, minus: a, value: SIMD3(repeating: value), weight: weights[pair])
      }
    }
    return try system.solve(tolerance: 1e-9, control).map(\.x)
  }
}

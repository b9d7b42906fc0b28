import Foundation
import Kernels
import SceneModel

/// Guided matching: a second matching pass over pairs with few matches. Once the epipolar geometry
/// of a pair is known, features are matched only to candidates near their epipolar line, where
/// similar features elsewhere in the photo can't cause ambiguity. New matches must change scale and
/// orientation consistently with the known ones.
package struct GuidedMatching {
  package struct Options: Hashable, Codable, Sendable {
    /// Pairs with at least this number of matches are skipped. Chosen.
    package var sufficientMatches = 60
    package var matching = EpipolarMatching()

    package init() {}
  }

  package var options: Options
  /// Verifies the new matches; its error limit also bounds the distance from the epipolar line.
  package var verification: PairVerification

  package init(_ options: Options, verification: PairVerification) {
    (self.options, self.verification) = (options, verification)
  }

  /// Returns the graph with the additional matches of pairs with few matches and known geometry.
  package func run(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], cameras: [Camera],
    _ context: StageContext
  ) throws -> ViewGraph {
    let cameraOfPhoto = photos.map { cameras[$0.camera.index] }
    let weak = graph.pairs.indices.filter {
      let pair = graph.pairs[$0]
      return pair.matches.count < options.sufficientMatches
        && verification.isCalibrated(
          (cameraOfPhoto[pair.pair.first.index], cameraOfPhoto[pair.pair.second.index]))
    }
    let isNeeded = Set(weak.flatMap { [graph.pairs[$0].pair.first, graph.pairs[$0].pair.second] })
    let points = try context.control.parallelMap(photos.count) { index in
      isNeeded.contains(ID(index))
        ? cameraOfPhoto[index].normalizedPositions(of: features[index]) : []
    }
    let better = try context.control.parallelMap(weak.count) { index in
      try guided(graph.pairs[weak[index]], features, points, cameraOfPhoto)
    }
    var result = graph
    for (index, pair) in zip(weak, better) { result.pairs[index] = pair }
    context.notes.record("guidedMatches", Double(result.matchCount - graph.matchCount))
    return result
  }

  /// The pair with additional matches, or unchanged if they don't help.
  private func guided(
    _ pair: VerifiedPair, _ features: [FeatureSet], _ points: [[SIMD2<Double>]],
    _ cameraOfPhoto: [Camera]
  ) throws -> VerifiedPair {
    guard let secondFromFirst = pair.secondFromFirst else { return pair }
    let (first, second) = (pair.pair.first.index, pair.pair.second.index)
    let cameras = (cameraOfPhoto[first], cameraOfPhoto[second])
    var matching = options.matching
    matching.maximumError = verification.maximumError(cameras)
    let new = try matching.matches(
      .init(features[first], points: points[first], except: pair.matches.map(\.first)),
      .init(features[second], points: points[second], except: pair.matches.map(\.second)),
      matrix: secondFromFirst.essentialMatrix, KernelControl()
    )
    .filter(LocalFrames(pair.matches, features[first], features[second]).agrees)
    guard !new.isEmpty else { return pair }
    let verdict = try verification.verify(
      pair.pair, pair.matches + new, points: (points[first], points[second]), cameras: cameras)
    guard case .verified(let better) = verdict, better.matches.count > pair.matches.count else {
      return pair
    }
    return better
  }
}

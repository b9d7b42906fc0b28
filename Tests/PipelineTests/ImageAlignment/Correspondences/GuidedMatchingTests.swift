import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct GuidedMatchingTests {
  private static let scene: SyntheticScene = {
    var options = SyntheticScene.Options()
    (options.photoCount, options.pixelNoise) = (6, 0.3)
    return SyntheticScene(options)
  }()
  private static let known = 40

  /// The scene's pairs with only a few of their matches, and after guided matching of the given
  /// features.
  private func guided(_ features: [FeatureSet]) throws -> (before: ViewGraph, after: ViewGraph) {
    var graph = Self.scene.viewGraph
    for index in graph.pairs.indices {
      graph.pairs[index].matches.removeLast(max(0, graph.pairs[index].matches.count - Self.known))
    }
    var camera = Self.scene.camera
    camera.calibration = .exif
    let after = try GuidedMatching(.init(), verification: PairVerification()).run(
      graph, features: features, photos: Self.scene.photos, cameras: [camera],
      StageContext(control: KernelControl()))
    return (graph, after)
  }

  private func isCorrect(_ match: FeatureMatch, _ pair: PhotoPair) -> Bool {
    Self.scene.pointOfFeature[pair.first.index][Int(match.first)]
      == Self.scene.pointOfFeature[pair.second.index][Int(match.second)]
  }

  @Test func weakPairsGainCorrectMatches() throws {
    let (before, after) = try guided(Self.scene.features)
    let pairs = zip(before.pairs, after.pairs)
    #expect(pairs.allSatisfy { $1.matches.count >= $0.matches.count })
    #expect(pairs.contains { $1.matches.count > 2 * $0.matches.count })
    for pair in after.pairs {
      let right = pair.matches.count { isCorrect($0, pair.pair) }
      #expect(Double(right) >= 0.98 * Double(pair.matches.count))
    }
  }

  @Test func inconsistentScaleOrOrientationIsRejected() throws {
    var features = Self.scene.features
    var isOdd = features.map { $0.scales.map { _ in false } }
    for photo in features.indices where photo % 2 == 1 {
      let taken = Set(
        Self.scene.viewGraph.pairs.flatMap { pair in
          pair.matches.prefix(Self.known).compactMap {
            pair.pair.first.index == photo
              ? $0.first : pair.pair.second.index == photo ? $0.second : nil
          }
        })
      for feature in features[photo].scales.indices where !taken.contains(Int32(feature)) {
        isOdd[photo][feature] = true
        if feature % 2 == 0 {
          features[photo].scales[feature] *= 3
        } else {
          features[photo].orientations[feature] += 1.5
        }
      }
    }
    let (before, after) = try guided(features)
    for (old, new) in zip(before.pairs, after.pairs) {
      let (first, second) = (new.pair.first.index, new.pair.second.index)
      guard first % 2 != second % 2 else { continue }
      let added = Set(new.matches).subtracting(old.matches)
      #expect(
        added.allSatisfy { !isOdd[first][Int($0.first)] && !isOdd[second][Int($0.second)] })
    }
  }
}

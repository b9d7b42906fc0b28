import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

/// Photos of a wall on which a pattern repeats beside an object that is unique.
@Suite struct RepetitiveFeaturesTests {
  private let uniqueCount = 60

  /// Two photos of the same features: unique ones, then `patternCount` of a pattern, then the same
  /// pattern again 500 pixels to the right.
  private func photos(patternCount: Int) -> (graph: ViewGraph, features: [FeatureSet]) {
    var random = SeededGenerator(seed: 8)
    func descriptor() -> [UInt8] {
      let values = (0..<128).map { _ in Double.random(in: 0...1, using: &random) }
      let norm = values.reduce(0) { $0 + $1 * $1 }.squareRoot()
      return values.map { UInt8(512 * $0 / norm) }
    }
    func noisy(_ descriptor: [UInt8]) -> [UInt8] {
      descriptor.map { UInt8(max(0, Int($0) + Int.random(in: -6...6, using: &random))) }
    }
    let unique = (0..<uniqueCount).map { _ in descriptor() }
    let pattern = (0..<patternCount).map { _ in descriptor() }
    func photo() -> FeatureSet {
      let descriptors = (unique + pattern + pattern).flatMap(noisy)
      let count = uniqueCount + 2 * patternCount
      return FeatureSet(
        positions: (0..<count).map { index in
          let isSecond = index >= uniqueCount + patternCount
          return SIMD2(isSecond ? 600 : 100, Float(20 * (isSecond ? index - patternCount : index)))
        },
        scales: Array(repeating: 1, count: count),
        orientations: Array(repeating: 0, count: count), descriptors: descriptors,
        colors: Array(repeating: .zero, count: count))
    }
    let features = [photo(), photo()]
    let matches = (0..<Int32(features[0].count)).map { FeatureMatch(first: $0, second: $0) }
    let pair = VerifiedPair(
      pair: PhotoPair(ID(0), ID(1)), model: .essential, secondFromFirst: nil, matches: matches,
      medianAngle: 0.1)
    return (ViewGraph(photoCount: 2, pairs: [pair]), features)
  }

  @Test func thePatternIsNotDistinctive() throws {
    var (graph, features) = photos(patternCount: 40)
    // As similar as most matches, not as three quarters: the noise differs.
    var search = RepetitiveFeatures()
    search.options.matchShare = 1
    let kept = try search.distinctiveFeatures(graph, features, KernelControl())
    let expected = Array(0..<uniqueCount)
    for photo in 0..<2 {
      let found = try #require(kept?[photo])
      #expect(found.starts(with: expected))
      #expect(found.count < uniqueCount + 10)
    }
    // Features without matches are judged as well.
    graph.pairs[0].matches.removeLast(40)
    #expect(try search.distinctiveFeatures(graph, features, KernelControl()) == kept)
  }

  @Test func fewRepeatedFeaturesDoNotMatter() throws {
    let (graph, features) = photos(patternCount: 2)
    #expect(
      try RepetitiveFeatures().distinctiveFeatures(graph, features, KernelControl()) == nil)
  }

  /// Where an object seems to move, a pattern matters if it is in the surroundings: it may not have
  /// moved.
  @Test(arguments: [true, false])
  func thePatternMattersInSurroundingsThatSeemToMove(isInSurroundings: Bool) throws {
    var (graph, features) = photos(patternCount: 40)
    graph.omitsSurroundings = true
    graph.surroundings = features.map { set in
      (0..<set.count).map { ($0 >= uniqueCount) == isInSurroundings }
    }
    var search = RepetitiveFeatures()
    search.options.matchShare = 1
    let kept = try search.distinctiveFeatures(graph, features, KernelControl())
    #expect((kept != nil) == isInSurroundings)
  }

  @Test func withoutMatchesNothingIsKnown() throws {
    let (_, features) = photos(patternCount: 40)
    let graph = ViewGraph(photoCount: 2, pairs: [])
    #expect(
      try RepetitiveFeatures().distinctiveFeatures(graph, features, KernelControl()) == nil)
  }
}

import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MotionLayersTests {
  /// Which of the bodies comes first in each pair depends on the seed.
  @Test(arguments: [1, 2, 3, 4] as [UInt64])
  func featuresAroundTheObjectAreSurroundings(seed: UInt64) throws {
    let scene = LayeredPhotos(.objectInside, seed: seed)
    try expectSurroundings(of: scene)
  }

  /// Between most photos the object stays where it is.
  @Test func pairsWithOneMotionAreDivided() throws {
    let scene = LayeredPhotos(.objectInside, isMovedOnce: true)
    #expect(scene.graph.pairs.count > scene.graph.motions.count)
    try expectSurroundings(of: scene)
  }

  /// What does not move is the surroundings even if it is nearer to the middle of the photos, in
  /// all pairs or in every third one.
  @Test(arguments: [1, 3]) func staticFeaturesAreSurroundings(staticStep: Int) throws {
    let scene = LayeredPhotos(.objectAround, staticStep: staticStep)
    let isStatic = scene.graph.motions.map(\.isFirstStatic)
    #expect(isStatic.contains(true))
    try expectSurroundings(of: scene)
  }

  @Test(arguments: [0, 2.5]) func equalRotationsAreNoBodies(degrees: Double) throws {
    let scene = LayeredPhotos(.objectInside, degrees: degrees)
    #expect(try !scene.hasSurroundings())
  }

  @Test func repeatedStructureIsNoBody() throws {
    let scene = LayeredPhotos(.interleaved)
    #expect(try !scene.hasSurroundings())
  }

  @Test func tracksWithoutABodyAreNoBodies() throws {
    let scene = LayeredPhotos(.objectInside, isMixed: true)
    #expect(try !scene.hasSurroundings())
  }

  /// Expects exactly the features and the matches of the surroundings.
  private func expectSurroundings(of scene: LayeredPhotos) throws {
    let found = try #require(try scene.surroundings())
    #expect(found.hasFeature == scene.isSurrounding)
    #expect(scene.isSurrounding.allSatisfy { $0.contains(true) && $0.contains(false) })
    for (pair, matches) in scene.matches {
      #expect(matches[0].allSatisfy { found.contain($0, of: pair) })
      #expect(!matches[1].contains { found.contain($0, of: pair) })
    }
  }
}

/// Photos with features of surroundings, body 0, and of an object that moves in front of them, body
/// 1, with matches between all photos.
private struct LayeredPhotos {
  /// Where the features of the object are: in the middle of the photos, around the surroundings, or
  /// among them.
  enum Layout { case objectInside, objectAround, interleaved }

  private static let photoCount = 6
  private static let surroundingCount = 50
  private static let objectCount = 30
  /// Points without a match.
  private static let otherCount = 5

  private let photos: [Photo]
  private let features: [FeatureSet]
  private(set) var graph: ViewGraph
  /// The matches of both bodies.
  private(set) var matches: [PhotoPair: [[FeatureMatch]]] = [:]
  /// Whether each feature is one of the surroundings and has a match, by photo.
  private(set) var isSurrounding: [[Bool]]

  /// The object turns by `degrees` between two photos, or only between the first and the second
  /// half of the photos. The surroundings are static in every pair of number `staticStep`. If the
  /// bodies are mixed, matches belong to either of them at random.
  init(
    _ layout: Layout, degrees: Double = 20, staticStep: Int? = nil, isMovedOnce: Bool = false,
    isMixed: Bool = false, seed: UInt64 = 1
  ) {
    var random = SeededGenerator(seed: seed)
    let count = Self.surroundingCount + Self.objectCount + Self.otherCount
    // The feature of each point, by photo.
    let order = (0..<Self.photoCount).map { _ in (0..<count).shuffled(using: &random) }
    photos = (0..<Self.photoCount).map { index in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
        width: 1600, height: 1200, orientation: 1, camera: ID<Camera>(0))
    }
    features = order.map { featureOfPoint in
      var positions = [SIMD2<Float>](repeating: .zero, count: count)
      for (point, feature) in featureOfPoint.enumerated() {
        positions[feature] = Self.position(of: point, layout, &random)
      }
      return FeatureSet(positions: positions)
    }
    graph = ViewGraph(photoCount: Self.photoCount, pairs: [])
    isSurrounding = order.map { $0.map { _ in false } }
    for first in 0..<Self.photoCount {
      for second in (first + 1)..<Self.photoCount {
        let pair = PhotoPair(ID(first), ID(second))
        let matches = Self.matches(order[first], order[second], isMixed: isMixed, &random)
        self.matches[pair] = matches
        let half = Self.photoCount / 2
        if isMovedOnce, (first < half) == (second < half) {
          graph.pairs.append(Self.verified(pair, matches[0] + matches[1], degrees: 0))
        } else {
          let number = graph.motions.count
          let isStatic = staticStep.map { number % $0 == 0 } ?? false
          add(pair, matches, degrees: degrees, isStatic: isStatic, isSwapped: random.below(2) == 1)
        }
        for match in matches[0] {
          isSurrounding[first][Int(match.first)] = true
          isSurrounding[second][Int(match.second)] = true
        }
      }
    }
  }

  func surroundings() throws -> MotionLayers.Surroundings? {
    try MotionLayers().surroundings(graph, features: features, photos: photos, StageContext())
  }

  func hasSurroundings() throws -> Bool { try surroundings() != nil }

  /// Adds a pair with two motions.
  private mutating func add(
    _ pair: PhotoPair, _ matches: [[FeatureMatch]], degrees: Double, isStatic: Bool,
    isSwapped: Bool
  ) {
    var bodies = [
      Self.verified(pair, matches[0], degrees: 0),
      Self.verified(pair, matches[1], degrees: degrees),
    ]
    if isStatic {
      bodies[0].secondFromFirst = nil
    } else if isSwapped {
      bodies.swapAt(0, 1)
    }
    graph.pairs.append(bodies[0])
    graph.motions.append(TwoMotions(pair: pair, bodies: bodies, isFirstStatic: isStatic))
  }

  /// The matches of both bodies, without those of some points.
  private static func matches(
    _ first: [Int], _ second: [Int], isMixed: Bool, _ random: inout SeededGenerator
  ) -> [[FeatureMatch]] {
    var matches: [[FeatureMatch]] = [[], []]
    for point in 0..<(surroundingCount + objectCount) {
      guard random.uniform() < 0.75 else { continue }
      let body = isMixed ? random.below(2) : point < surroundingCount ? 0 : 1
      matches[body].append(
        FeatureMatch(first: Int32(first[point]), second: Int32(second[point])))
    }
    return matches
  }

  private static func verified(
    _ pair: PhotoPair, _ matches: [FeatureMatch], degrees: Double
  ) -> VerifiedPair {
    VerifiedPair(
      pair: pair, model: .essential,
      secondFromFirst: RigidTransform(
        rotation: Quaternion(angle: degrees * .pi / 180, axis: [0, 1, 0]),
        translation: [1, 0, 0]),
      matches: matches.sorted { $0.first < $1.first }, medianAngle: 0.1)
  }

  /// A random pixel of the part of the photos where the point is.
  private static func position(
    of point: Int, _ layout: Layout, _ random: inout SeededGenerator
  ) -> SIMD2<Float> {
    let isObject = point >= surroundingCount && point < surroundingCount + objectCount
    let isInside = isObject == (layout == .objectInside)
    while true {
      let (x, y) = (1600 * random.uniform(), 1200 * random.uniform())
      let distance = max(abs(x - 800), abs(y - 600))
      if layout == .interleaved || (isInside ? distance < 150 : distance > 300) {
        return SIMD2<Float>(Float(x), Float(y))
      }
    }
  }
}

import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SecondMotionSearchTests {
  @Test func bothBodiesAreFound() throws {
    let scene = MovingScene(
      cameras: (0..<3).map(MovingScene.movedCamera),
      objects: (0..<3).map { MovingScene.turned(0.25 * Double($0), about: [1, 0.3, 0]) })
    let motions = try scene.motions()
    #expect(motions.map(\.pair) == scene.pairs)
    for motion in motions {
      #expect(!motion.isFirstStatic && motion.bodies.count == 2)
      for (body, found) in motion.bodies.enumerated() {
        #expect(found.matches == scene.matches(of: body, motion.pair))
        let pose = try #require(found.secondFromFirst)
        let truth = scene.relativePose(of: body, motion.pair)
        #expect((pose.rotation.conjugate * truth.rotation).angle < 0.5 * .pi / 180)
        #expect(pose.translation.normalized.dot(truth.translation.normalized) > 0.999)
      }
    }
  }

  @Test func rigidSceneWithOutliersHasOneMotion() throws {
    let scene = MovingScene(
      cameras: (0..<3).map(MovingScene.movedCamera),
      objects: [.identity, .identity, .identity], outlierRatio: 0.3)
    let graph = try scene.firstMotions()
    #expect(graph.pairs.map(\.pair) == scene.pairs)
    // Enough matches are unexplained for the pairs to be examined.
    #expect(graph.pairs.allSatisfy { $0.matches.count <= MovingScene.pointCount - 20 })
    #expect(try scene.motions(graph: graph).isEmpty)
  }

  /// The geometries of pairs of a plane are ambiguous: some are wrong, and contradict what stands
  /// in front of the plane.
  @Test func wrongMotionsOfAPlaneAreNoSecondMotions() throws {
    let scene = MovingScene(
      cameras: (0..<5).map(MovingScene.movedCamera),
      objects: (0..<5).map { _ in .identity }, areSurroundingsPlanar: true)
    let ofPlane = scene.pairs.map { scene.matches(of: 0, $0) }
    let graph = try scene.firstMotions(of: ofPlane)
    // By the limit for matches of another motion, twice 0.0012 of the longer side.
    let contradicted = graph.pairs.filter { pair in
      let matrix = (pair.secondFromFirst ?? .identity).essentialMatrix
      let object = scene.matches(of: 1, pair.pair)
      let far = object.count { match in
        let points = scene.normalizedPositions(of: match, pair.pair)
        return matrix.sampsonError(points.first, points.second) > 0.0024 * 1600 / 1400
      }
      return Double(far) >= 0.7 * Double(object.count)
    }
    #expect(!contradicted.isEmpty)
    #expect(try scene.motions(graph: graph).isEmpty)
  }

  /// The object moves before the last of five photos: four of ten pairs show two motions.
  @Test func sceneIsRigidIfFewPairsHaveTwoMotions() throws {
    let last = MovingScene.turned(0.25, about: [1, 0.3, 0])
    let scene = MovingScene(
      cameras: (0..<5).map(MovingScene.movedCamera),
      objects: [.identity, .identity, .identity, .identity, last], outlierRatio: 0.2)
    let graph = try scene.firstMotions()
    #expect(graph.pairs.map(\.pair) == scene.pairs)
    #expect(graph.pairs.allSatisfy { $0.matches.count <= MovingScene.pointCount - 20 })
    var options = SecondMotionSearch.Options()
    options.minimumShare = 0.3
    let moving = scene.pairs.filter { $0.second.index == 4 }
    #expect(try scene.motions(options, graph: graph).map(\.pair) == moving)
    options.minimumShare = 0.5
    #expect(try scene.motions(options, graph: graph).isEmpty)
  }

  /// On a turntable seen from above, by a camera that does not move; whether or not the object's
  /// motion is that of the pair.
  @Test(arguments: [false, true])
  func staticBackgroundIsTheFirstBody(isObjectKnown: Bool) throws {
    var scene = MovingScene(
      cameras: [.identity, .identity],
      objects: [.identity, MovingScene.turned(0.4, about: [0, 1, 0.6])])
    // Features are not located exactly.
    for point in stride(from: 0, to: MovingScene.surroundingsCount, by: 10) {
      scene.features[1].positions[MovingScene.feature(point, 1)] += SIMD2<Float>(3, -3)
    }
    let pair = scene.pairs[0]
    var graph = ViewGraph(photoCount: 2, pairs: [])
    if isObjectKnown {
      graph.pairs = [
        VerifiedPair(
          pair: pair, model: .essential, secondFromFirst: scene.relativePose(of: 1, pair),
          matches: scene.matches(of: 1, pair), medianAngle: 0.1)
      ]
    }
    let motions = try scene.motions(graph: graph)
    #expect(motions.count == 1)
    let motion = try #require(motions.first)
    #expect(motion.isFirstStatic && motion.bodies.count == 2)
    #expect(motion.bodies[0].secondFromFirst == nil)
    #expect(motion.bodies[0].matches == scene.matches(of: 0, pair))
    #expect(motion.bodies[1].matches == scene.matches(of: 1, pair))
    let pose = try #require(motion.bodies[1].secondFromFirst)
    let truth = scene.relativePose(of: 1, pair)
    #expect((pose.rotation.conjugate * truth.rotation).angle < 0.5 * .pi / 180)
  }

  /// A camera that turns about an axis sees the points on it at the same pixels.
  @Test func pointsOnTheAxisOfTheCameraAreNoBackground() throws {
    let center: SIMD3<Double> = [0, 0, 8]
    let rotation = Quaternion(angle: 0.2, axis: [0, 1, 0])
    let orbit = RigidTransform(rotation: rotation, translation: center - rotation * center)
    var scene = MovingScene(cameras: [.identity, orbit], objects: [.identity, .identity])
    for point in 0..<30 {
      let pixel = MovingScene.camera.project(center + [0, 0.05 * Double(point), 0])
      for photo in 0..<2 {
        scene.features[photo].positions[MovingScene.feature(point, photo)] = SIMD2<Float>(pixel)
      }
    }
    #expect(try scene.motions().isEmpty)
  }

  @Test func disabledSearchFindsNothing() throws {
    let scene = MovingScene(
      cameras: (0..<2).map(MovingScene.movedCamera),
      objects: [.identity, MovingScene.turned(0.25, about: [1, 0.3, 0])])
    var options = SecondMotionSearch.Options()
    #expect(try scene.motions(options).count == 1)
    options.isEnabled = false
    #expect(try scene.motions(options).isEmpty)
  }
}

/// Photos of an object and of surroundings between which it moves, with matches between all of
/// them.
private struct MovingScene {
  static let camera = Camera(
    width: 1600, height: 1200, focalLength: [1400, 1400], calibration: .exif)
  /// The first points are those of the surroundings, the others those of the object.
  static let surroundingsCount = 120
  static let pointCount = 180

  let photos: [Photo]
  var features: [FeatureSet]
  /// All pairs of photos, and the matches of each, one per point.
  let pairs: [PhotoPair]
  let matches: [[FeatureMatch]]
  /// `cameraFromBody` of the surroundings and of the object, by photo.
  private let poses: [[RigidTransform]]

  /// `cameras` has `cameraFromWorld`, `objects` has `worldFromObject` of each photo.
  init(
    cameras: [RigidTransform], objects: [RigidTransform], outlierRatio: Double = 0,
    areSurroundingsPlanar: Bool = false
  ) {
    var random = SeededGenerator(seed: 1)
    let count = cameras.count
    let surroundings = Self.points(
      Self.surroundingsCount, center: [0, 0, 8], size: [3, 2, areSurroundingsPlanar ? 0 : 1.5],
      &random)
    let object = Self.points(
      Self.pointCount - Self.surroundingsCount, center: [0.3, 0, 4], size: [0.7, 0.7, 0.7], &random)
    let points = surroundings + object
    let objectPoses = zip(cameras, objects).map { camera, object in camera * object }
    photos = (0..<count).map { index in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
        width: 1600, height: 1200, orientation: 1, camera: ID<Camera>(0))
    }
    features = (0..<count).map { photo in
      var positions = [SIMD2<Float>](repeating: .zero, count: points.count)
      for (point, position) in points.enumerated() {
        let pose = point < Self.surroundingsCount ? cameras[photo] : objectPoses[photo]
        positions[Self.feature(point, photo)] = SIMD2<Float>(Self.camera.project(pose * position))
      }
      return FeatureSet(positions: positions)
    }
    let pairs = (0..<count).flatMap { first in
      ((first + 1)..<count).map { second in PhotoPair(ID(first), ID(second)) }
    }
    matches = pairs.map { pair in
      (0..<Self.pointCount).map { point in
        let isWrong = random.uniform() < outlierRatio
        return Self.match(point, isWrong ? random.below(Self.pointCount) : point, pair)
      }
    }
    self.pairs = pairs
    poses = zip(cameras, objectPoses).map { camera, object in [camera, object] }
  }

  /// A camera that moves and turns a little with each photo.
  static func movedCamera(_ photo: Int) -> RigidTransform {
    let step: SIMD3<Double> = [-0.5, 0.05, 0.1]
    return RigidTransform(
      rotation: Quaternion(angle: 0.04 * Double(photo), axis: [0, 1, 0]),
      translation: Double(photo) * step)
  }

  /// A rotation of the object by `angle` radians about an axis that passes behind it.
  static func turned(_ angle: Double, about axis: SIMD3<Double>) -> RigidTransform {
    let rotation = Quaternion(angle: angle, axis: axis)
    let center: SIMD3<Double> = [0.3, 0, 6]
    return RigidTransform(rotation: rotation, translation: center - rotation * center)
  }

  /// The feature of a point in a photo.
  static func feature(_ point: Int, _ photo: Int) -> Int { (point + 7 * photo) % pointCount }

  /// The correct matches of the surroundings, body 0, or of the object, body 1.
  func matches(of body: Int, _ pair: PhotoPair) -> [FeatureMatch] {
    (0..<Self.pointCount).filter { ($0 < Self.surroundingsCount) == (body == 0) }
      .map { Self.match($0, $0, pair) }.sorted { $0.first < $1.first }
  }

  /// The two features of a match at depth 1.
  func normalizedPositions(
    of match: FeatureMatch, _ pair: PhotoPair
  ) -> (first: SIMD2<Double>, second: SIMD2<Double>) {
    (
      Self.camera.normalizedPositions(of: [match], in: features[pair.first.index], \.first)[0],
      Self.camera.normalizedPositions(of: [match], in: features[pair.second.index], \.second)[0]
    )
  }

  /// `secondFromFirst` of a body.
  func relativePose(of body: Int, _ pair: PhotoPair) -> RigidTransform {
    poses[pair.second.index][body] * poses[pair.first.index][body].inverse
  }

  /// The motions of all matches, or of given ones of each pair.
  func firstMotions(of given: [[FeatureMatch]]? = nil) throws -> ViewGraph {
    try PairVerification().run(
      pairs, matches: given ?? matches, features: features, photos: photos, cameras: [Self.camera],
      StageContext())
  }

  func motions(
    _ options: SecondMotionSearch.Options = SecondMotionSearch.Options(), graph: ViewGraph? = nil
  ) throws -> [TwoMotions] {
    let first = try graph ?? firstMotions()
    return try SecondMotionSearch(options, verification: PairVerification()).run(
      pairs, matches: matches, graph: first, features: features, photos: photos,
      cameras: [Self.camera], StageContext())
  }

  private static func match(_ point: Int, _ other: Int, _ pair: PhotoPair) -> FeatureMatch {
    FeatureMatch(
      first: Int32(feature(point, pair.first.index)),
      second: Int32(feature(other, pair.second.index)))
  }

  /// Points of a box; `size` is half its extent.
  private static func points(
    _ count: Int, center: SIMD3<Double>, size: SIMD3<Double>, _ random: inout SeededGenerator
  ) -> [SIMD3<Double>] {
    (0..<count).map { _ in
      let (x, y, z) = (random.uniform(), random.uniform(), random.uniform())
      let offset = SIMD3<Double>(2 * x - 1, 2 * y - 1, 2 * z - 1)
      return center + size * offset
    }
  }
}

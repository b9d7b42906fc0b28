import Foundation
import Pipeline
import SceneModel
import TestSupport
import Testing

@Suite struct WorldAlignmentTests {
  /// A scene with a table under the ball, in a random frame such as alignment produces.
  private func scene(
    table: Bool, layout: SyntheticScene.Layout = .ring, seed: UInt64 = 1
  ) -> Reconstruction {
    var options = SyntheticScene.Options()
    options.layout = layout
    var result = SyntheticScene(options).reconstruction
    var random = SeededGenerator(seed: seed)
    if table {
      for _ in 0..<400 {
        let x = 4 * random.uniform() - 2
        result.points.append(ScenePoint(position: [x, -1.1, 4 * random.uniform() - 2]))
      }
    }
    let oldFromScene = SimilarityTransform(
      scale: 0.37, rotation: Quaternion(angle: 6 * random.uniform(), axis: random.normal3()),
      translation: random.normal3())
    result.poses = result.poses.map { $0.map(oldFromScene.applied(toCameraFromA:)) }
    for index in result.points.indices {
      result.points[index].position = oldFromScene * result.points[index].position
    }
    return result
  }

  private func lowest(_ reconstruction: Reconstruction) -> Double {
    reconstruction.points.map(\.position.y).min() ?? .nan
  }

  private func distances(_ reconstruction: Reconstruction) -> [Double] {
    reconstruction.poses.compactMap { $0?.center.length }.sorted()
  }

  @Test(arguments: [1, 2, 3] as [UInt64]) func tableIsTheGround(seed: UInt64) {
    let notes = StageNotes()
    let aligned = WorldAlignment().run(scene(table: true, seed: seed), StageContext(notes: notes))
    #expect(aligned.worldFrame == WorldFrame(scale: .arbitrary, up: .supportPlane))
    #expect(notes.warnings.count == 1)
    let table = aligned.points.suffix(400).map(\.position.y)
    #expect(table.allSatisfy { abs($0) < 0.01 })
    #expect(aligned.poses.allSatisfy { ($0?.center.y ?? 0) > 0.1 })
    let median = distances(aligned)[6]
    #expect(median > 0.9 && median < 1.3)
    // The ball is on the table, above the origin.
    let ball = aligned.points.prefix(700).map(\.position)
    let mean = ball.reduce(.zero, +) / 700
    #expect(abs(mean.x) < 0.05 && abs(mean.z) < 0.05 && mean.y > 0.1)
    #expect(aligned.meanReprojectionError < 1e-2)
  }

  /// Gravity in the camera frames, with +y of the scene up.
  private func gravity(noise: Double) -> [Int: SensorReading] {
    var random = SeededGenerator(seed: 5)
    var result: [Int: SensorReading] = [:]
    for (index, pose) in SyntheticScene().poses.enumerated() {
      let down: SIMD3<Double> = pose.rotation * SIMD3(0, -1, 0)
      result[index] = SensorReading(gravity: (down + noise * random.normal3()) * 9.81)
    }
    return result
  }

  /// Angle in degrees between the up direction of the aligned scene and the true one.
  private func tilt(_ aligned: Reconstruction) throws -> Double {
    let pose = try #require(aligned.poses[0])
    let truth = SyntheticScene().poses[0].rotation
    let up = pose.rotation.conjugate * (truth * SIMD3(0, 1, 0))
    return acos(min(1, up.y)) * 180 / .pi
  }

  @Test func gravityDeterminesUp() throws {
    var alignment = WorldAlignment()
    alignment.options.readings = gravity(noise: 0.01)
    for table in [false, true] {
      let aligned = alignment.run(scene(table: table), StageContext())
      #expect(aligned.worldFrame.up == .gravity)
      #expect(try tilt(aligned) < 1)
      #expect(abs(lowest(aligned)) < 0.05)
    }
  }

  /// The object is turned, stands on the ground, and the vertical is remembered.
  @Test(arguments: ChosenUp.Axis.allCases) func chosenAxisIsUp(axis: ChosenUp.Axis) {
    var alignment = WorldAlignment()
    let scene = scene(table: true)
    let automatic = alignment.run(scene, StageContext())
    alignment.options.chosenUp = .model(axis)
    let turned = alignment.run(scene, StageContext())
    // The same point, seen from the centroid.
    func offset(_ scene: Reconstruction) -> SIMD3<Double> {
      let points = scene.points.prefix(700).map(\.position)
      return points[0] - points.reduce(.zero, +) / 700
    }
    #expect(abs(offset(turned).y - offset(automatic).dot(axis.direction)) < 1e-9)
    #expect(abs(offset(turned).length - offset(automatic).length) < 1e-9)
    let table = turned.points.suffix(400).map { $0.position.dot(turned.worldFrame.vertical) }
    #expect((table.max() ?? 1) - (table.min() ?? 0) < 0.02)
    #expect((turned.worldFrame.turnedVertical == nil) == (axis == .y))
    let ball = turned.points.prefix(700).map(\.position.y)
    #expect(ball.count { $0 > -0.02 } > 650)
  }

  /// The cameras were turned upside down, and the user says so.
  @Test func chosenSideOfThePhotosIsUp() throws {
    var alignment = WorldAlignment()
    alignment.options.chosenUp = .photos(.bottom)
    var scene = scene(table: false)
    let roll = Quaternion(angle: .pi, axis: [0, 0, 1])
    scene.poses = scene.poses.map { pose in
      pose.map {
        RigidTransform(rotation: roll * $0.rotation, translation: roll * $0.translation)
      }
    }
    let aligned = alignment.run(scene, StageContext())
    #expect(aligned.worldFrame.up == .chosen)
    let pose = try #require(aligned.poses[0])
    let truth = SyntheticScene().poses[0].rotation
    let up = (roll * pose.rotation).conjugate * (truth * SIMD3<Double>(0, 1, 0))
    #expect(acos(min(1, up.y)) * 180 / .pi < 2)
  }

  /// The up direction of another alignment of some of the photos.
  @Test func upOfAnotherAlignmentIsUsed() throws {
    var scene = scene(table: false)
    // On their side, as the other alignment knows.
    let roll = Quaternion(angle: 1.2, axis: [0, 0, 1])
    scene.poses = scene.poses.map { pose in
      pose.map {
        RigidTransform(rotation: roll * $0.rotation, translation: roll * $0.translation)
      }
    }
    var upright = SyntheticScene().poses.map { pose -> RigidTransform? in
      RigidTransform(rotation: roll * pose.rotation, translation: roll * pose.translation)
    }
    upright[1] = nil
    let aligned = WorldAlignment().run(scene, posesInUpFrame: upright, StageContext())
    let pose = try #require(aligned.poses[0])
    let truth = SyntheticScene().poses[0].rotation
    let up = pose.rotation.conjugate * (roll * (truth * SIMD3<Double>(0, 1, 0)))
    #expect(acos(min(1, up.y)) * 180 / .pi < 1)
  }

  @Test func gravityMayBeWrongInSomePhotos() throws {
    var alignment = WorldAlignment()
    alignment.options.readings = gravity(noise: 0.01)
    for index in 0..<4 { alignment.options.readings[index]?.gravity = [0, 0.6, 0.8] }
    let aligned = alignment.run(scene(table: false), StageContext())
    #expect(aligned.worldFrame.up == .gravity)
    #expect(try tilt(aligned) < 1)
  }

  @Test func gravityInAnotherFrameIsNotUsed() throws {
    var alignment = WorldAlignment()
    // As if the camera had been rotated by a quarter turn.
    alignment.options.readings = gravity(noise: 0).mapValues {
      SensorReading(gravity: $0.gravity.map { SIMD3(-$0.y, $0.x, $0.z) })
    }
    let notes = StageNotes()
    let aligned = alignment.run(scene(table: true), StageContext(notes: notes))
    #expect(aligned.worldFrame.up == .supportPlane)
    #expect(notes.warnings.contains { $0.contains("gravity") && $0.contains("phone") })
  }

  /// Depth maps of 64 × 48 pixels: of a ball with the mean radius of the points in front of a
  /// distant wall, at `metersPerUnit` meters per unit.
  private func depthMaps(
    metersPerUnit: Double, noise: Double = 0
  ) throws -> [Int: SensorReading] {
    var random = SeededGenerator(seed: 8)
    let scene = SyntheticScene()
    var result: [Int: SensorReading] = [:]
    for (index, pose) in scene.poses.enumerated() {
      let camera = scene.reconstruction.camera(of: ID(index))
      let center = pose * .zero
      var depths: [Float] = []
      for row in 0..<48 {
        for column in 0..<64 {
          let place = SIMD2((Double(column) + 0.5) / 64, (Double(row) + 0.5) / 48)
          let ray = camera.unproject(place * SIMD2(Double(camera.width), Double(camera.height)))
          let direction = SIMD3(ray.x, ray.y, 1)
          let half = direction.dot(center) / direction.squaredLength
          let discriminant =
            half * half - (center.squaredLength - 1.05 * 1.05) / direction.squaredLength
          let depth = discriminant > 0 ? half - discriminant.squareRoot() : 40
          depths.append(Float(depth * metersPerUnit * (1 + noise * (random.uniform() - 0.5))))
        }
      }
      result[index] = SensorReading(depth: DepthMap(width: 64, height: 48, depths: depths))
    }
    return result
  }

  /// Meters of the aligned scene per unit of the true one, from the distance between two cameras.
  private func metersPerUnit(_ aligned: Reconstruction) throws -> Double {
    let truth = SyntheticScene().poses
    let (a, b) = (try #require(aligned.poses[0]), try #require(aligned.poses[5]))
    return (a.center - b.center).length / (truth[0].center - truth[5].center).length
  }

  @Test func depthMapsGiveTheScale() throws {
    var alignment = WorldAlignment()
    alignment.options.readings = try depthMaps(metersPerUnit: 0.08, noise: 0.04)
    let notes = StageNotes()
    let aligned = alignment.run(scene(table: false), StageContext(notes: notes))
    #expect(aligned.worldFrame.scale == .depth)
    #expect(abs(try metersPerUnit(aligned) / 0.08 - 1) < 0.01)
    #expect(notes.counts["depthMapsUsed"] == notes.counts["depthMaps"])
    #expect(notes.warnings.isEmpty)
  }

  @Test func disparitiesAreDistinguishedFromDepths() throws {
    for areDisparities in [true, false] {
      var alignment = WorldAlignment()
      for (index, reading) in try depthMaps(metersPerUnit: 0.5, noise: 0.04) {
        let depth = try #require(reading.depth)
        var map = DepthMap(
          width: depth.width, height: depth.height,
          depths: depth.depths.map { areDisparities ? 1 / $0 : $0 })
        map?.mayBeDisparities = true
        alignment.options.readings[index] = SensorReading(depth: map)
      }
      let aligned = alignment.run(scene(table: false), StageContext())
      #expect(aligned.worldFrame.scale == .depth)
      #expect(abs(try metersPerUnit(aligned) / 0.5 - 1) < 0.01)
    }
  }

  @Test func depthMapsMayBeWrongInSomePhotos() throws {
    var alignment = WorldAlignment()
    alignment.options.readings = try depthMaps(metersPerUnit: 2)
    let wrong = try depthMaps(metersPerUnit: 3)
    for index in 0..<3 { alignment.options.readings[index] = wrong[index] }
    alignment.options.readings[3]?.depth = DepthMap(width: 1, height: 1, depths: [.nan])
    let aligned = alignment.run(scene(table: true), StageContext())
    #expect(abs(try metersPerUnit(aligned) / 2 - 1) < 0.01)
  }

  @Test func unrelatedDepthMapsAreNotUsed() throws {
    var random = SeededGenerator(seed: 2)
    var alignment = WorldAlignment()
    for index in SyntheticScene().poses.indices {
      // Constant depth, different for each photo.
      let depth = Float(1 + 9 * random.uniform())
      alignment.options.readings[index] = SensorReading(
        depth: DepthMap(width: 4, height: 3, depths: [Float](repeating: depth, count: 12)))
    }
    let notes = StageNotes()
    let aligned = alignment.run(scene(table: false), StageContext(notes: notes))
    #expect(aligned.worldFrame.scale == .arbitrary)
    #expect(notes.warnings.contains { $0.contains("depth maps") && $0.contains("meters") })
  }

  @Test func depthAtEdgesIsUnknown() throws {
    let map = try #require(DepthMap(width: 4, height: 1, depths: [1, 1, 1, 3]))
    #expect(map.depth(at: [0.1, 0.5]) == 1 && map.depth(at: [0.3, 0.5]) == 1)
    #expect(map.depth(at: [0.6, 0.5]) == nil && map.depth(at: [0.9, 0.5]) == nil)
    #expect(map.depth(at: [1, 0.5]) == nil && map.depth(at: [-0.1, 0.5]) == nil)
    #expect(map.depth(at: [.nan, 0.5]) == nil)
    #expect(DepthMap(width: 2, height: 2, depths: [1]) == nil)
  }

  @Test func camerasDetermineUpWithoutAPlane() {
    let before = scene(table: false)
    let aligned = WorldAlignment().run(before, StageContext())
    #expect(aligned.worldFrame.up == .cameras)
    #expect(abs(lowest(aligned)) < 0.1)
    // Cameras without roll: their x axes are horizontal.
    for pose in aligned.poses {
      let x = (pose ?? .identity).rotation.conjugate * SIMD3(1, 0, 0)
      #expect(abs(x.y) < 0.01)
    }
    #expect(abs(aligned.meanReprojectionError - before.meanReprojectionError) < 1e-6)
  }

  @Test func firstPhotoIsInFront() throws {
    let aligned = WorldAlignment().run(scene(table: true), StageContext())
    let center = try #require(aligned.poses[0]).center
    #expect(center.z > 0.5 && abs(center.x) < 0.1)
  }

  /// GPS positions of the true camera centers, at `metersPerUnit` meters per unit of the scene.
  private func located(_ metersPerUnit: Double, noise: Double) -> Reconstruction {
    var random = SeededGenerator(seed: 8)
    var result = scene(table: true)
    let truth = SyntheticScene().poses
    for index in result.photos.indices {
      let meters = metersPerUnit * truth[index].center + noise * random.normal3()
      result.photos[index].position = GeographicPosition(
        latitudeDegrees: 48 - meters.z / 111_198.0,
        longitudeDegrees: 9 + meters.x / (111_414.0 * cos(48 * Double.pi / 180)),
        altitude: 300 + meters.y)
    }
    return result
  }

  @Test func gpsGivesScaleUpAndNorth() {
    let aligned = WorldAlignment().run(located(20, noise: 1), StageContext())
    #expect(aligned.worldFrame == WorldFrame(scale: .gps, up: .gps))
    let truth = SyntheticScene().poses.map { 20 * $0.center }
    // The ground is the table, 22 m below the center of the ball.
    for (pose, center) in zip(aligned.poses, truth) {
      #expect(((pose ?? .identity).center - center - [0, 22, 0]).length < 5)
    }
  }

  @Test func gpsAsWideAsItsNoiseIsNotUsed() {
    let aligned = WorldAlignment().run(located(0.5, noise: 4), StageContext())
    #expect(aligned.worldFrame.scale == .arbitrary)
    #expect(aligned.worldFrame.up == .supportPlane)
  }

  @Test func gpsOutliersAreRejected() {
    var input = located(20, noise: 0.5)
    input.photos[3].position?.latitudeDegrees += 0.01
    let aligned = WorldAlignment().run(input, StageContext())
    #expect(aligned.worldFrame.scale == .gps)
    let distance = ((aligned.poses[0]?.center ?? .zero) - (aligned.poses[6]?.center ?? .zero))
      .length
    let truth = SyntheticScene().poses
    #expect(abs(distance - 20 * (truth[0].center - truth[6].center).length) < 5)
  }

  @Test func knownDistanceSetsTheScale() {
    var options = WorldAlignment.Options()
    options.knownDistances = [
      .init(from: .camera("photo000.jpg"), to: .camera("photo003.jpg"), meters: 2.5)
    ]
    let notes = StageNotes()
    let aligned = WorldAlignment(options).run(scene(table: true), StageContext(notes: notes))
    #expect(aligned.worldFrame.scale == .knownDistance)
    #expect(notes.warnings.isEmpty)
    let distance = ((aligned.poses[0]?.center ?? .zero) - (aligned.poses[3]?.center ?? .zero))
      .length
    #expect(abs(distance - 2.5) < 1e-9)
  }

  /// A distance between two points of the ball, each picked in two photos.
  private func picked(_ meters: Double, pixelError: Double) throws -> KnownDistance {
    let scene = SyntheticScene()
    let ends = [SIMD3(0.3, 0.9, 0.2), SIMD3(0.1, 0.5, 0.8)].map { point in
      KnownDistance.End.point(
        [0, 1].map { photo in
          let pixel = scene.camera.project(scene.poses[photo] * point)
          return .init(
            photo: "photo00\(photo).jpg", x: pixel.x, y: pixel.y + (photo == 0 ? pixelError : 0))
        })
    }
    return KnownDistance(from: ends[0], to: ends[1], meters: meters)
  }

  @Test func pickedPointsSetTheScaleBeforeGPS() throws {
    var options = WorldAlignment.Options()
    options.knownDistances = [try picked(0.25, pixelError: 0)]
    let notes = StageNotes()
    let aligned = WorldAlignment(options).run(located(20, noise: 1), StageContext(notes: notes))
    #expect(aligned.worldFrame == WorldFrame(scale: .knownDistance, up: .gps))
    #expect(notes.warnings.isEmpty)
    let truth = SyntheticScene().poses
    let meters = 0.25 / (SIMD3(0.3, 0.9, 0.2) - SIMD3(0.1, 0.5, 0.8)).length
    let distance = ((aligned.poses[0]?.center ?? .zero) - (aligned.poses[6]?.center ?? .zero))
      .length
    #expect(abs(distance / (truth[0].center - truth[6].center).length / meters - 1) < 1e-3)
    #expect(notes.counts["knownDistances"] == 1)
  }

  @Test func unusableDistancesAreReported() throws {
    var options = WorldAlignment.Options()
    options.knownDistances = [
      .init(from: .camera("photo000.jpg"), to: .camera("absent.jpg"), meters: 1),
      .init(from: .camera("photo001.jpg"), to: .camera("photo001.jpg"), meters: 1),
      try picked(0.25, pixelError: 40),
      .init(from: .camera("photo000.jpg"), to: .camera("photo001.jpg"), meters: 100),
    ]
    let notes = StageNotes()
    let aligned = WorldAlignment(options).run(scene(table: true), StageContext(notes: notes))
    #expect(aligned.worldFrame.scale == .knownDistance)
    for part in ["absent.jpg", "same place", "pixels away", "disagree"] {
      #expect(notes.warnings.contains { $0.contains(part) }, "no warning contains '\(part)'")
    }
  }

  /// Numbers of files and options that no photos have.
  @Test func impossibleDistancesAreReported() throws {
    func distance(_ meters: Double, _ name: String = "photo003.jpg") -> KnownDistance {
      KnownDistance(from: .camera("photo000.jpg"), to: .camera(name), meters: meters)
    }
    var options = WorldAlignment.Options()
    options.knownDistances = [
      distance(1e300), distance(.nan), distance(-1), distance(1e6), distance(1e-6, "photo001.jpg"),
      try picked(0.25, pixelError: 1e120),
    ]
    let notes = StageNotes()
    let aligned = WorldAlignment(options).run(scene(table: true), StageContext(notes: notes))
    #expect(aligned.worldFrame.scale == .knownDistance)
    #expect(notes.warnings.count { $0.contains("must be from 0.000001 to 1000000 m") } == 3)
    #expect(notes.warnings.contains { $0.contains("disagree") })
    #expect(aligned.points.allSatisfy { $0.position.length.isFinite })
  }

  @Test func residualOfGPSIsItsNoise() throws {
    let notes = StageNotes()
    _ = WorldAlignment().run(located(20, noise: 1.5), StageContext(notes: notes))
    let horizontal = try #require(notes.counts["gpsHorizontalRMS"])
    let vertical = try #require(notes.counts["gpsVerticalRMS"])
    // Two axes combined; seven of 36 degrees of freedom are absorbed by the fit.
    #expect(horizontal > 1.2 && horizontal < 2.8)
    #expect(vertical > 0.6 && vertical < 2.2)
    #expect(notes.counts["gpsPositionsUsed"] == 12)
    #expect(notes.details.contains { $0.hasPrefix("GPS: 12 of 12") })
  }

  @Test func positionsWithoutAltitudesGiveScaleAndNorth() {
    var input = located(20, noise: 0.5)
    for index in input.photos.indices { input.photos[index].position?.altitude = nil }
    let notes = StageNotes()
    let aligned = WorldAlignment().run(input, StageContext(notes: notes))
    #expect(aligned.worldFrame == WorldFrame(scale: .gps, up: .supportPlane))
    #expect(notes.counts["gpsVerticalRMS"] == nil)
    for (pose, truth) in zip(aligned.poses, SyntheticScene().poses) {
      let error = (pose ?? .identity).center - 20 * truth.center - SIMD3(0, 22, 0)
      #expect(error.length < 2.5)
    }
  }

  /// A plain table shows few points, but they form one thin layer with nothing below it.
  @Test(arguments: [1, 2] as [UInt64]) func fewPointsOfATableAreEnough(seed: UInt64) {
    var input = scene(table: true, seed: seed)
    input.points.removeLast(330)
    let aligned = WorldAlignment().run(input, StageContext())
    #expect(aligned.worldFrame.up == .supportPlane)
    #expect(aligned.points.suffix(70).allSatisfy { abs($0.position.y) < 0.02 })
  }

  @Test func reconstructionWithoutPosesIsUnchanged() {
    var empty = scene(table: false)
    empty.poses = empty.poses.map { _ in nil }
    empty.points = []
    let aligned = WorldAlignment().run(empty, StageContext())
    #expect(aligned.poses == empty.poses && aligned.points.isEmpty)
    #expect(aligned.cameras == empty.cameras && aligned.worldFrame == empty.worldFrame)
  }
}

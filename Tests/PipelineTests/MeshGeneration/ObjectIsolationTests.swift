import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ObjectIsolationTests {
  /// A ball on a table with a block of clutter far from the focus.
  func ballOnTable(tilt: Double = 0) -> (IsolationScene, Reconstruction) {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    let normal = Quaternion(angle: tilt, axis: [0, 0, 1]) * SIMD3<Double>(0, 1, 0)
    scene.addBall(center: 0.5 * normal, radius: 0.5, label: 1, centers: centers)
    scene.addPlane(normal: normal, radius: 2.2, label: 0, centers: centers) {
      ($0 - normal.dot($0) * normal).length > 0.12
    }
    let aside = Quaternion(angle: tilt, axis: [0, 0, 1]) * SIMD3<Double>(1.7, 0.1, 0)
    scene.addBall(center: aside, radius: 0.12, label: 2, centers: centers)
    return (scene, reconstruction)
  }

  /// The share of the points with a label that are kept; points within `band` of the support are
  /// ignored, as they belong to both.
  func keptShare(
    _ result: ObjectIsolation.Result, _ scene: IsolationScene, label: Int
  ) -> Double {
    let members = scene.labels.indices.filter { index in
      guard scene.labels[index] == label, label != 0, let support = result.support else {
        return scene.labels[index] == label
      }
      return support.height(of: SIMD3<Double>(scene.cloud.positions[index])) > 2 * support.band
    }
    return Double(members.filter { result.isKept[$0] }.count) / Double(max(1, members.count))
  }

  @Test(arguments: [0, 0.1, 0.3]) func objectIsKeptAndSupportRemoved(tilt: Double) throws {
    let (scene, reconstruction) = ballOnTable(tilt: tilt)
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    #expect(result.failure == nil)
    #expect(keptShare(result, scene, label: 1) >= 0.99)
    #expect(keptShare(result, scene, label: 0) <= 0.01)
    #expect(keptShare(result, scene, label: 2) <= 0.01)
  }

  @Test func supportPlaneIsDetected() throws {
    let (scene, reconstruction) = ballOnTable(tilt: 0.2)
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    let support = try #require(result.support)
    let normal = Quaternion(angle: 0.2, axis: [0, 0, 1]) * SIMD3<Double>(0, 1, 0)
    #expect(support.normal.dot(normal) > 0.9999)
    #expect(abs(support.offset) < 0.005)
  }

  /// The underside of the ball hides the stem that it stands on; nothing links the two.
  @Test func baseOfTheObjectBelongsToIt() throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(center: [0, 0.8, 0], radius: 0.5, label: 1, centers: centers) { $0.y > 0.6 }
    scene.addBall(center: [0, 0.1, 0], radius: 0.12, label: 2, centers: centers) { $0.y > 0 }
    scene.addBall(center: [1.2, 0.1, 0], radius: 0.12, label: 3, centers: centers) { $0.y > 0 }
    scene.addPlane(radius: 2.2, label: 0, centers: centers)
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    #expect(result.failure == nil)
    #expect(keptShare(result, scene, label: 1) >= 0.99)
    #expect(keptShare(result, scene, label: 2) >= 0.99)
    #expect(keptShare(result, scene, label: 3) == 0)
    #expect(keptShare(result, scene, label: 0) <= 0.01)
  }

  /// The top of the base has more points than the turntable, which has little texture. A table
  /// whose side is visible in a room, however, supports what stands on it.
  @Test(arguments: [true, false]) func topOfTheBaseIsNoSupport(isInRoom: Bool) throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(center: [0, 0.35, 0], radius: 0.35, label: 1, centers: centers)
    scene.addPlane(radius: 0.5, label: 2, centers: centers) { $0.length > 0.1 }
    for turn in 0..<150 {
      let out = SIMD3(cos(Double(turn) * .pi / 75), 0, sin(Double(turn) * .pi / 75))
      for layer in 1...13 {
        scene.add(
          0.5 * out - [0, 0.02 * Double(layer), 0], normal: out, label: 3, centers: centers)
      }
      for ring in 0..<8 where (turn + ring) % 2 == 0 {
        scene.add(
          (0.53 + 0.06 * Double(ring)) * out - [0, 0.26, 0], normal: [0, 1, 0], label: 0,
          centers: centers)
      }
    }
    if isInRoom {
      for turn in 0..<12 {
        let angle = Double(turn) * .pi / 6
        scene.addBall(
          center: [1.6 * cos(angle), 0.1, 1.6 * sin(angle)], radius: 0.2, label: 4,
          centers: centers)
      }
    }
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    #expect(result.failure == nil)
    let support = try #require(result.support)
    #expect(abs(support.offset - (isInRoom ? 0 : -0.26)) < 0.02)
    #expect(keptShare(result, scene, label: 1) >= 0.99)
    #expect(keptShare(result, scene, label: 3) == (isInRoom ? 0 : 1))
    #expect(keptShare(result, scene, label: 0) <= 0.01)
  }

  @Test func objectWithoutSupportIsIsolated() throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(center: [0, 0.4, 0], radius: 0.5, label: 1, centers: centers)
    scene.addBall(center: [8, 0, 0], radius: 1, label: 2, centers: centers)
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    #expect(result.failure == nil)
    #expect(keptShare(result, scene, label: 1) >= 0.99)
    #expect(keptShare(result, scene, label: 2) == 0)
  }

  @Test func twoObjectsAtTheFocusAreBothKept() throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(center: [-0.4, 0.3, 0], radius: 0.3, label: 1, centers: centers)
    scene.addBall(center: [0.4, 0.3, 0], radius: 0.3, label: 2, centers: centers)
    scene.addPlane(radius: 2.2, label: 0, centers: centers)
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    #expect(keptShare(result, scene, label: 1) >= 0.99)
    #expect(keptShare(result, scene, label: 2) >= 0.99)
    #expect(keptShare(result, scene, label: 0) <= 0.01)
  }

  @Test func bareTableIsNotAnObject() throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addPlane(radius: 2.2, label: 0, centers: centers)
    let result = try ObjectIsolation().run(scene.cloud, reconstruction, StageContext())
    #expect(result.failure != nil && result.support == nil)
    #expect(result.isKept.count == scene.cloud.count && result.isKept.allSatisfy { $0 })
  }

  /// Nothing is above the only plane that is seen: in front of a plain backdrop, it is a face of
  /// the object.
  @Test(arguments: [true, false]) func flatObjectInFrontOfABackdropIsKept(
    isForeground: Bool
  ) throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addPlane(radius: 0.6, label: 1, centers: centers)
    // Noise far from it, as on the backdrop.
    for turn in 0..<40 {
      scene.addBall(
        center: [1.3 * cos(Double(turn)), -0.2, 1.3 * sin(Double(turn))], radius: 0.06, label: 0,
        centers: centers)
    }
    var isolation = ObjectIsolation()
    isolation.options.isForeground = isForeground
    let result = try isolation.run(scene.cloud, reconstruction, StageContext())
    #expect((result.failure == nil) == isForeground)
    if isForeground {
      #expect(keptShare(result, scene, label: 1) >= 0.99)
      #expect(keptShare(result, scene, label: 0) <= 0.01)
    }
  }

  @Test func sparsePointsGiveTheObjectBounds() throws {
    let (scene, empty) = ballOnTable()
    var reconstruction = empty
    for index in stride(from: 0, to: scene.cloud.count, by: 7) {
      let track = scene.cloud.visiblePhotos(of: index).map {
        Observation(photo: ID(Int($0)), feature: 0, pixel: .zero)
      }
      reconstruction.points.append(
        ScenePoint(position: SIMD3<Double>(scene.cloud.positions[index]), track: track))
    }
    let box = try #require(
      try MeshGeneration().bounds(nil, reconstruction, StageContext()))
    #expect((box.max - SIMD3<Float>(0.5, 1, 0.5)).length < 0.08)
    #expect((box.min - SIMD3<Float>(-0.5, 0, -0.5)).length < 0.15)
  }

  @Test func emptyCloudHasNoBounds() throws {
    let reconstruction = IsolationScene().reconstruction()
    #expect(try MeshGeneration().bounds(nil, reconstruction, StageContext()) == nil)
  }
}

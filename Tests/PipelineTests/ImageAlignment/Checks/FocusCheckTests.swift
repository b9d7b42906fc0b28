import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct FocusCheckTests {
  /// Photos around a ball with a feature for each of its points, and `others` features without a
  /// point in the middle of each photo.
  private func scene(
    others: Int, keeping isKept: (SIMD3<Double>) -> Bool = { _ in true }
  ) -> (Reconstruction, [FeatureSet]) {
    var scene = SyntheticScene().reconstruction
    var features = scene.photos.map { _ in FeatureSet() }
    for index in scene.points.indices {
      for (number, observation) in scene.points[index].track.enumerated() {
        let photo = observation.photo.index
        scene.points[index].track[number].feature = Int32(features[photo].count)
        features[photo].positions.append(SIMD2<Float>(observation.pixel))
      }
    }
    scene.points = scene.points.filter { isKept($0.position) }
    var random = SeededGenerator(seed: 3)
    for photo in scene.photos {
      let camera = scene.camera(of: photo.id)
      let size = SIMD2(Float(camera.width), Float(camera.height))
      for _ in 0..<others {
        let offset = SIMD2(Float(random.uniform() - 0.5), Float(random.uniform() - 0.5))
        features[photo.id.index].positions.append(size * (0.5 + 0.1 * offset))
      }
    }
    return (scene, features)
  }

  private func concerns(_ scene: (Reconstruction, [FeatureSet])) -> Int {
    let notes = StageNotes()
    FocusCheck().run(scene.0, scene.1, notes) { nil }
    return notes.concerns.count
  }

  @Test func observedFeaturesInTheMiddleAreNoConcern() {
    #expect(concerns(scene(others: 0)) == 0)
    #expect(concerns(scene(others: 10)) == 0)
  }

  /// The middle of the photos has many features, but none of a point.
  @Test func featuresWithoutPointsInTheMiddleAreAConcern() {
    #expect(concerns(scene(others: 2000)) == 1)
  }

  /// A dense cloud shows whether the middle stands still, but has no texture for features; `hole`
  /// is the radius around the middle without a point, as a share of the photos' longer sides.
  @Test(arguments: [(0.0, 0), (0.14, 1)])
  func denseCloudDecidesOverFeaturesWithoutPoints(hole: Double, concernCount: Int) throws {
    let (scene, features) = scene(others: 2000)
    var random = SeededGenerator(seed: 5)
    var cloud = PointCloud()
    for _ in 0..<20_000 {
      let offset = SIMD3(random.uniform(), random.uniform(), random.uniform()) - 0.5
      let point = 1.5 * offset.normalized
      let photos = try scene.registered.filter { photo in
        let (camera, pose) = (scene.camera(of: photo), try #require(scene.poses[photo.index]))
        let distance = (camera.project(pose * point) - camera.project(pose * .zero)).length
        return distance >= hole * Double(max(camera.width, camera.height))
      }
      cloud.positions.append(SIMD3<Float>(point))
      cloud.photoIndices += photos.map { UInt16($0.index) }
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
    let notes = StageNotes()
    FocusCheck().run(scene, features, notes) { cloud }
    #expect(notes.concerns.count == concernCount)
    let share = try #require(notes.counts["denseFocusShare"])
    #expect(concernCount == 0 ? share > 0.9 : share < 0.1)
  }

  @Test func fewFeaturesAreNotInformative() {
    #expect(concerns(scene(others: 0) { $0.length > 10 }) == 0)
  }

  /// An object that was turned in front of a camera that stood still: aligned by the table, all
  /// photos seem to be taken from one place.
  @Test func photosFromOneDirectionAreAConcern() throws {
    var (scene, features) = scene(others: 0)
    let first = try #require(scene.poses[0])
    for index in scene.poses.indices {
      let step = Quaternion(angle: 0.002 * Double(index), axis: [0, 1, 0])
      scene.poses[index] = first * RigidTransform(rotation: step, translation: .zero)
    }
    let findings = try #require(FocusCheck().findings(scene, features))
    #expect(findings.spreadDegrees < 8)
    #expect(concerns((scene, features)) == 1)
  }

  /// A map without the repetitive features of an object's own texture.
  @Test(arguments: [(0.3, false), (0.7, true)])
  func focusIsKeptByEnoughObservations(share: Double, isKept: Bool) {
    let (first, features) = scene(others: 0)
    var other = first
    other.points = first.points.prefix(Int(share * Double(first.points.count))).map { $0 }
    let check = FocusCheck()
    #expect(check.isKept(from: first, in: other, features, minimumShare: 0.5) == isKept)
    #expect(check.isKept(from: other, in: first, features, minimumShare: 0.5))
  }

  @Test func withoutAFocusThereIsNoneToKeep() {
    let (first, features) = scene(others: 0)
    var unposed = first
    for index in unposed.poses.indices { unposed.poses[index] = nil }
    let check = FocusCheck()
    #expect(check.isKept(from: unposed, in: first, features, minimumShare: 0.5))
    #expect(!check.isKept(from: first, in: unposed, features, minimumShare: 0.5))
  }
}

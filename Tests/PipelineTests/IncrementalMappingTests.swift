import Foundation
import Kernels
import Pipeline
import SceneModel
import TestSupport
import Testing

@Suite struct IncrementalMappingTests {
  private func map(
    _ scene: SyntheticScene, focalFactor: Double = 1, threads: Int = 1
  ) throws -> Reconstruction {
    var camera = scene.camera
    camera.focalLength *= focalFactor
    camera.distortion = .zero
    return try IncrementalMapping().run(
      scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [camera],
      StageContext(control: KernelControl(threadCount: threads)))
  }

  @Test(arguments: SyntheticScene.Layout.allCases, [0, 0.2, 0.4])
  func allPhotosAreRegistered(layout: SyntheticScene.Layout, outliers: Double) throws {
    var options = SyntheticScene.Options()
    options.layout = layout
    options.photoCount = layout == .ring ? 16 : 10
    options.pixelNoise = 0.3
    options.outlierRatio = outliers
    options.relativePoseNoise = 0.01
    let scene = SyntheticScene(options)
    let result = try map(scene)
    #expect(result.registered.count == options.photoCount)
    #expect(result.unregistered.isEmpty)
    #expect(result.meanReprojectionError < 0.6)
    let poses = PoseComparison(estimated: result.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 0.03)
    #expect(poses.maximumRotationError < 0.015)
    #expect(result.points.count > 300)
  }

  @Test(arguments: [0.85, 1.2]) func wrongFocalLengthIsCorrected(factor: Double) throws {
    var options = SyntheticScene.Options()
    options.photoCount = 16
    options.pixelNoise = 0.2
    options.camera.distortion = [-0.06, 0.01, 0, 0]
    let scene = SyntheticScene(options)
    let result = try map(scene, focalFactor: factor)
    #expect(result.registered.count == 16)
    #expect(abs(result.cameras[0].focalLength.x / 1400 - 1) < 0.01)
    #expect(result.cameras[0].calibration == .refined)
    #expect(result.meanReprojectionError < 0.4)
  }

  @Test func planarSceneIsMapped() throws {
    var options = SyntheticScene.Options()
    options.isPlanar = true
    options.pixelNoise = 0.2
    let scene = SyntheticScene(options)
    let result = try map(scene)
    #expect(result.registered.count == 12)
    let poses = PoseComparison(estimated: result.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 0.05)
  }

  @Test func smallerComponentIsReported() throws {
    var options = SyntheticScene.Options()
    options.photoCount = 16
    options.secondComponentStart = 10
    let scene = SyntheticScene(options)
    let result = try map(scene)
    #expect(result.registered.map(\.index) == Array(0..<10))
    #expect(result.unregistered.map(\.sampleID) == Array(10..<16))
    #expect(result.unregistered.allSatisfy { $0.fault == .notRegistered })
    #expect(result.unregistered.allSatisfy { $0.reason.contains("separate group of 6 photos") })
  }

  @Test func photoWithoutMatchesIsReported() throws {
    let scene = SyntheticScene()
    let graph = ViewGraph(
      photoCount: 12,
      pairs: scene.viewGraph.pairs.filter { $0.pair.first.index != 4 && $0.pair.second.index != 4 })
    let result = try IncrementalMapping().run(
      graph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
      StageContext())
    #expect(result.registered.count == 11)
    #expect(result.unregistered.map(\.name) == ["photo004.jpg"])
    #expect(result.unregistered.allSatisfy { $0.reason.contains("no matches") })
  }

  @Test(arguments: MappingMethod.allCases) func theNearestPhotoIsNamed(
    method: MappingMethod
  ) throws {
    let scene = SyntheticScene()
    let pairs = scene.viewGraph.pairs.filter {
      $0.pair.first.index != 4 && $0.pair.second.index != 4
    }
    let graph = ViewGraph(
      photoCount: 12, pairs: pairs,
      rejected: [
        RejectedPair(pair: PhotoPair(ID(3), ID(4)), matches: 9, needed: 20),
        RejectedPair(pair: PhotoPair(ID(4), ID(5)), matches: 12, needed: 20),
      ])
    var options = SparseMapping.Options()
    options.method = method
    let result = try SparseMapping(options).run(
      graph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
      StageContext())
    let reason = try #require(result.unregistered.first).reason
    #expect(reason.contains("only 12 matches with photo005.jpg"))
    #expect(reason.contains("20 are needed"))
  }

  @Test func emptyGraphGivesNoPoses() throws {
    let scene = SyntheticScene()
    let result = try IncrementalMapping().run(
      ViewGraph(photoCount: 12, pairs: []), features: scene.features, photos: scene.photos,
      cameras: [scene.camera], StageContext())
    #expect(result.registered.isEmpty)
    #expect(result.unregistered.count == 12)
  }

  @Test func resultIsTheSameAtAnyThreadCount() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.4
    options.outlierRatio = 0.2
    let scene = SyntheticScene(options)
    let (one, two) = (try map(scene, threads: 1), try map(scene, threads: 2))
    let isSame =
      one.poses == two.poses && one.points == two.points && one.cameras == two.cameras
    #expect(isSame)
  }

  @Test func cancelStopsTheGrowth() {
    let scene = SyntheticScene()
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > 0.3 { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try IncrementalMapping().run(
        scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
        StageContext(control: control))
    }
  }
}

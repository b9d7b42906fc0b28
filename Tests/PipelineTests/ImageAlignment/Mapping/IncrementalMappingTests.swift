import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@Suite struct IncrementalMappingTests {
  @Test(.endToEnd, arguments: SyntheticScene.Layout.allCases, [0, 0.2, 0.4])
  func allPhotosAreRegistered(layout: SyntheticScene.Layout, outliers: Double) throws {
    let scene = SyntheticScene(.noisy(layout, outliers: outliers))
    let result = try scene.mapped(.incremental)
    #expect(result.registered.count == scene.photos.count)
    #expect(result.unregistered.isEmpty)
    #expect(result.meanReprojectionError < 0.6)
    let poses = scene.comparison(result)
    #expect(poses.maximumCenterError < 0.03)
    #expect(poses.maximumRotationError < 0.015)
    #expect(result.points.count > 300)
  }

  @Test(arguments: [0.85, 1.2]) func wrongFocalLengthIsCorrected(factor: Double) throws {
    var options = SyntheticScene.Options()
    options.photoCount = 16
    options.pixelNoise = 0.2
    options.camera.distortion = [-0.06, 0.01, 0, 0]
    let result = try SyntheticScene(options).mapped(.incremental, focalFactor: factor)
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
    let result = try scene.mapped(.incremental)
    #expect(result.registered.count == 12)
    #expect(scene.comparison(result).maximumCenterError < 0.05)
  }

  @Test func photoWithoutMatchesIsReported() throws {
    let scene = SyntheticScene()
    let graph = ViewGraph(photoCount: 12, pairs: scene.pairs(without: 4))
    let result = try scene.mapped(.incremental, graph: graph)
    #expect(result.registered.count == 11)
    #expect(result.unregistered.map(\.name) == ["photo004.jpg"])
    #expect(result.unregistered.allSatisfy { $0.reason.contains("no matches") })
  }
}

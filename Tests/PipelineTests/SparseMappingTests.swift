import Foundation
import Kernels
import Pipeline
import SceneModel
import TestSupport
import Testing

@Suite struct SparseMappingTests {
  private func map(
    _ scene: SyntheticScene, _ method: MappingMethod, graph: ViewGraph? = nil,
    focalFactor: Double = 1, notes: StageNotes = StageNotes(), threads: Int = 1
  ) throws -> Reconstruction {
    var options = SparseMapping.Options()
    options.method = method
    var camera = scene.camera
    camera.focalLength *= focalFactor
    camera.distortion = .zero
    return try SparseMapping(options).run(
      graph ?? scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [camera],
      StageContext(control: KernelControl(threadCount: threads), notes: notes))
  }

  /// The pairs of photos up to `reach` apart in the order of capture.
  private func graph(_ scene: SyntheticScene, reach: Int) -> ViewGraph {
    ViewGraph(
      photoCount: scene.photos.count,
      pairs: scene.viewGraph.pairs.filter { $0.pair.second.index - $0.pair.first.index <= reach })
  }

  @Test(arguments: SyntheticScene.Layout.allCases, [0, 0.2, 0.4])
  func globalIsAsGoodAsIncremental(layout: SyntheticScene.Layout, outliers: Double) throws {
    var options = SyntheticScene.Options()
    options.layout = layout
    options.photoCount = layout == .ring ? 16 : 10
    options.pixelNoise = 0.3
    options.outlierRatio = outliers
    options.relativePoseNoise = 0.01
    let scene = SyntheticScene(options)
    let notes = StageNotes()
    let global = try map(scene, .global, notes: notes)
    #expect(notes.counts["globalPhotos"] == Double(options.photoCount))
    #expect(global.registered.count == options.photoCount)
    #expect(global.unregistered.isEmpty)
    #expect(global.meanReprojectionError < 0.6)
    let incremental = try map(scene, .incremental)
    let errors = [global, incremental].map {
      PoseComparison(estimated: $0.poses, true: scene.poses)
    }
    #expect(errors[0].maximumCenterError < 1.2 * errors[1].maximumCenterError + 0.002)
    // Rotations and the principal point make up for each other, so that they are known less well.
    #expect(errors.allSatisfy { $0.maximumRotationError < 0.015 })
    #expect(global.meanReprojectionError < 1.01 * incremental.meanReprojectionError)
    #expect(
      Double(global.points.count) > 0.98 * Double(incremental.points.count))
  }

  @Test func wrongRotationsAndFocalLengthAreOvercome() throws {
    var options = SyntheticScene.Options()
    options.photoCount = 24
    options.pixelNoise = 0.3
    options.relativePoseNoise = 0.01
    options.camera.distortion = [-0.06, 0.01, 0, 0]
    let scene = SyntheticScene(options)
    var graph = scene.viewGraph
    for index in stride(from: 3, to: graph.pairs.count, by: 7) {
      guard let pose = graph.pairs[index].secondFromFirst else { continue }
      graph.pairs[index].secondFromFirst?.rotation =
        Quaternion(angle: 1, axis: [0.3, 1, 0.2]) * pose.rotation
    }
    let notes = StageNotes()
    let result = try map(scene, .automatic, graph: graph, focalFactor: 0.9, notes: notes)
    #expect(notes.counts["globalPhotos"] == 24)
    #expect(result.registered.count == 24)
    #expect(abs(result.cameras[0].focalLength.x / 1400 - 1) < 0.01)
    let poses = PoseComparison(estimated: result.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 0.03)
  }

  @Test func pairsOfUnknownFocalLengthGetARotation() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.3
    let scene = SyntheticScene(options)
    var graph = scene.viewGraph
    for index in graph.pairs.indices {
      graph.pairs[index].model = .fundamental
      graph.pairs[index].secondFromFirst?.rotation = .identity
    }
    let notes = StageNotes()
    let result = try map(scene, .global, graph: graph, notes: notes)
    #expect(notes.counts["globalPhotos"] == 12)
    let poses = PoseComparison(estimated: result.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 0.03)
  }

  @Test func weakGraphIsMappedIncrementally() throws {
    var options = SyntheticScene.Options()
    options.layout = .arc
    options.pixelNoise = 0.3
    let scene = SyntheticScene(options)
    let notes = StageNotes()
    // Each photo hangs on its neighbours by one pair.
    let result = try map(scene, .automatic, graph: graph(scene, reach: 1), notes: notes)
    #expect(notes.counts["globalPhotos"] == 0)
    #expect(result.registered.count == 12)
    let expected = try map(scene, .incremental, graph: graph(scene, reach: 1))
    #expect(result.poses == expected.poses)
  }

  @Test func photoWithOnePairIsAddedAfterwards() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.3
    let scene = SyntheticScene(options)
    let graph = ViewGraph(
      photoCount: 12,
      pairs: scene.viewGraph.pairs.filter {
        $0.pair.second.index != 11 || $0.pair.first.index == 10
      })
    let notes = StageNotes()
    let result = try map(scene, .automatic, graph: graph, notes: notes)
    #expect(notes.counts["globalPhotos"] == 11)
    #expect(result.registered.count == 12)
    let poses = PoseComparison(estimated: result.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 0.03)
  }

  @Test func smallerComponentIsReported() throws {
    var options = SyntheticScene.Options()
    options.photoCount = 16
    options.secondComponentStart = 10
    let result = try map(SyntheticScene(options), .global)
    #expect(result.registered.map(\.index) == Array(0..<10))
    #expect(result.unregistered.map(\.sampleID) == Array(10..<16))
    #expect(result.unregistered.allSatisfy { $0.reason.contains("separate group of 6 photos") })
  }

  @Test func emptyGraphGivesNoPoses() throws {
    let scene = SyntheticScene()
    let result = try map(scene, .global, graph: ViewGraph(photoCount: 12, pairs: []))
    #expect(result.registered.isEmpty)
    #expect(result.unregistered.count == 12)
  }

  @Test func resultIsTheSameAtAnyThreadCount() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.4
    options.outlierRatio = 0.2
    let scene = SyntheticScene(options)
    let (one, two) = (try map(scene, .global), try map(scene, .global, threads: 2))
    let isSame =
      one.poses == two.poses && one.points == two.points && one.cameras == two.cameras
    #expect(isSame)
  }

  @Test(arguments: [0.15, 0.3]) func cancelStops(fraction: Double) {
    let scene = SyntheticScene()
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > fraction { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try SparseMapping().run(
        scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
        StageContext(control: control))
    }
  }
}

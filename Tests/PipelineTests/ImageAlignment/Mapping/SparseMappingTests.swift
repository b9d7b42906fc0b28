import Foundation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@Suite struct SparseMappingTests {
  /// The pairs of photos up to `reach` apart in the order of capture.
  private func graph(_ scene: SyntheticScene, reach: Int) -> ViewGraph {
    ViewGraph(
      photoCount: scene.photos.count,
      pairs: scene.viewGraph.pairs.filter { $0.pair.second.index - $0.pair.first.index <= reach })
  }

  @Test(.endToEnd, arguments: SyntheticScene.Layout.allCases, [0, 0.2, 0.4])
  func globalIsAsGoodAsIncremental(layout: SyntheticScene.Layout, outliers: Double) throws {
    let scene = SyntheticScene(.noisy(layout, outliers: outliers))
    let notes = StageNotes()
    let global = try scene.mapped(.global, notes: notes)
    #expect(notes.counts["globalPhotos"] == Double(scene.photos.count))
    #expect(global.registered.count == scene.photos.count)
    #expect(global.unregistered.isEmpty)
    #expect(global.meanReprojectionError < 0.6)
    let incremental = try scene.mapped(.incremental)
    let errors = [global, incremental].map(scene.comparison)
    #expect(errors[0].maximumCenterError < 1.2 * errors[1].maximumCenterError + 0.002)
    // Rotations and the principal point are correlated, so that they are less well determined.
    #expect(errors.allSatisfy { $0.maximumRotationError < 0.015 })
    #expect(global.meanReprojectionError < 1.01 * incremental.meanReprojectionError)
    #expect(
      Double(global.points.count) > 0.98 * Double(incremental.points.count))
  }

  @Test func mappingIsRobustToWrongRotationsAndFocalLength() throws {
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
    let result = try scene.mapped(.automatic, graph: graph, focalFactor: 0.9, notes: notes)
    #expect(notes.counts["globalPhotos"] == 24)
    #expect(result.registered.count == 24)
    #expect(abs(result.cameras[0].focalLength.x / 1400 - 1) < 0.01)
    #expect(scene.comparison(result).maximumCenterError < 0.03)
  }

  /// As with pairs of planes, whose relative rotations the matches don't determine.
  @Test func contradictingRotationsAreNoticed() throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.3
    let scene = SyntheticScene(options)
    var graph = scene.viewGraph
    #expect(try scene.rotationsAgree(graph))
    for index in graph.pairs.indices where index % 3 != 0 {
      guard let pose = graph.pairs[index].secondFromFirst else { continue }
      graph.pairs[index].secondFromFirst?.rotation =
        Quaternion(angle: 0.3, axis: [1, Double(index % 5) - 2, 0.2]) * pose.rotation
    }
    let notes = StageNotes()
    #expect(try !scene.rotationsAgree(graph, notes: notes))
    #expect(try #require(notes.counts["consistentTripletShare"]) < 0.5)
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
    let result = try scene.mapped(.global, graph: graph, notes: notes)
    #expect(notes.counts["globalPhotos"] == 12)
    #expect(scene.comparison(result).maximumCenterError < 0.03)
  }

  @Test func weakGraphIsMappedIncrementally() throws {
    var options = SyntheticScene.Options()
    options.layout = .arc
    options.pixelNoise = 0.3
    let scene = SyntheticScene(options)
    let notes = StageNotes()
    // Each photo is connected to its neighbors by single pairs.
    let result = try scene.mapped(.automatic, graph: graph(scene, reach: 1), notes: notes)
    #expect(notes.counts["globalPhotos"] == 0)
    #expect(result.registered.count == 12)
    let expected = try scene.mapped(.incremental, graph: graph(scene, reach: 1))
    #expect(result.poses == expected.poses)
  }

  /// Photos from number `first` on have one pair with the photo before them.
  @Test(arguments: [11, 8]) func photosWithOnePairAreAddedAfterward(_ first: Int) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.3
    let scene = SyntheticScene(options)
    let graph = ViewGraph(
      photoCount: 12,
      pairs: scene.viewGraph.pairs.filter {
        $0.pair.second.index < first || $0.pair.second.index - $0.pair.first.index == 1
      })
    let notes = StageNotes()
    let result = try scene.mapped(.automatic, graph: graph, notes: notes)
    #expect(notes.counts["globalPhotos"] == Double(first))
    #expect(result.registered.count == 12)
    #expect(scene.comparison(result).maximumCenterError < 0.03)
  }

  @Test(arguments: MappingMethod.allCases)
  func smallerComponentIsReported(method: MappingMethod) throws {
    var options = SyntheticScene.Options()
    options.photoCount = 16
    options.secondComponentStart = 10
    let result = try SyntheticScene(options).mapped(method)
    #expect(result.registered.map(\.index) == Array(0..<10))
    #expect(result.unregistered.map(\.sampleID) == Array(10..<16))
    #expect(result.unregistered.allSatisfy { $0.fault == .notRegistered })
    let first = try #require(result.unregistered.first)
    #expect(first.reason.contains("separate group of 6 photos"))
    #expect(
      result.unregistered.dropFirst().allSatisfy {
        $0.reason == "\($0.name) belongs to the separate group of \(first.name)."
      })
  }

  @Test(arguments: MappingMethod.allCases)
  func mostSimilarPhotoIsReported(method: MappingMethod) throws {
    let scene = SyntheticScene()
    let graph = ViewGraph(
      photoCount: 12, pairs: scene.pairs(without: 4),
      rejected: [
        RejectedPair(pair: PhotoPair(ID(3), ID(4)), matches: 9, needed: 20),
        RejectedPair(pair: PhotoPair(ID(4), ID(5)), matches: 12, needed: 20),
      ])
    let result = try scene.mapped(method, graph: graph)
    let reason = try #require(result.unregistered.first).reason
    #expect(reason.contains("only 12 matches with photo005.jpg"))
    #expect(reason.contains("20 are needed"))
  }

  @Test(arguments: MappingMethod.allCases)
  func emptyGraphGivesNoPoses(method: MappingMethod) throws {
    let graph = ViewGraph(photoCount: 12, pairs: [])
    let result = try SyntheticScene().mapped(method, graph: graph)
    #expect(result.registered.isEmpty)
    #expect(result.unregistered.count == 12)
  }

  @Test(arguments: [MappingMethod.incremental, .global])
  func resultIsTheSameAtAnyThreadCount(method: MappingMethod) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.4
    options.outlierRatio = 0.2
    let scene = SyntheticScene(options)
    let (one, two) = (
      try scene.mapped(method),
      try scene.mapped(method, control: KernelControl(threadCount: 2))
    )
    let isSame =
      one.poses == two.poses && one.points == two.points && one.cameras == two.cameras
    #expect(isSame)
  }

  @Test(arguments: [(MappingMethod.incremental, 0.3), (.automatic, 0.15), (.automatic, 0.3)])
  func cancellationStops(method: MappingMethod, fraction: Double) {
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > fraction { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try SyntheticScene().mapped(method, control: control)
    }
  }
}

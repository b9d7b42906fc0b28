import Foundation
import Kernels
import Pipeline
import SceneModel
import TestSupport
import Testing

@Suite struct CorrespondenceSearchTests {
  static func scene(
    _ layout: SyntheticScene.Layout = .ring, photos: Int = 10, noise: Double = 0.4,
    secondComponentStart: Int? = nil
  ) -> SyntheticScene {
    var options = SyntheticScene.Options()
    options.layout = layout
    options.photoCount = photos
    options.pixelNoise = noise
    options.secondComponentStart = secondComponentStart
    return SyntheticScene(options)
  }

  static func search(
    _ scene: SyntheticScene, camera: Camera? = nil, ordering: SampleOrdering = .unordered,
    threads: Int = 1
  ) throws -> (viewGraph: ViewGraph, cameras: [Camera]) {
    try CorrespondenceSearch().run(
      photos: scene.photos, cameras: [camera ?? scene.camera], features: scene.features,
      ordering: ordering, StageContext(control: KernelControl(threadCount: threads)))
  }

  static func exif(_ scene: SyntheticScene) -> Camera {
    var camera = scene.camera
    camera.calibration = .exif
    return camera
  }

  @Test(arguments: SyntheticScene.Layout.allCases)
  func relativePosesAreCorrect(layout: SyntheticScene.Layout) throws {
    let scene = Self.scene(layout)
    let graph = try Self.search(scene, camera: Self.exif(scene)).viewGraph
    let common = scene.viewGraph.pairs.filter { $0.matches.count >= 60 }
    #expect(graph.pairs.count >= common.count && graph.photoCount == 10)
    for pair in graph.pairs where pair.matches.count >= 60 {
      let (first, second) = (pair.pair.first.index, pair.pair.second.index)
      let truth = scene.poses[second] * scene.poses[first].inverse
      let pose = try #require(pair.secondFromFirst)
      #expect((pose.rotation * truth.rotation.conjugate).angle < 0.03)
      if pair.model == .essential {
        #expect(pose.translation.normalized.dot(truth.translation.normalized) > 0.999)
      }
      let right = pair.matches.filter {
        scene.pointOfFeature[first][Int($0.first)] == scene.pointOfFeature[second][Int($0.second)]
      }
      #expect(right.count == pair.matches.count)
      #expect(zip(pair.matches, pair.matches.dropFirst()).allSatisfy { $0.first < $1.first })
    }
  }

  @Test(arguments: [0.75, 1.3])
  func assumedFocalLengthIsCorrected(factor: Double) throws {
    let scene = Self.scene()
    var camera = scene.camera
    camera.calibration = .assumed
    camera.focalLength *= factor
    let result = try Self.search(scene, camera: camera)
    #expect(abs(result.cameras[0].focalLength.x / scene.camera.focalLength.x - 1) < 0.03)
    #expect(result.viewGraph.pairs.contains { $0.model == .essential })
    #expect(result.viewGraph.pairs.allSatisfy { $0.secondFromFirst != nil })
  }

  @Test func knownFocalLengthIsKept() throws {
    let scene = Self.scene()
    var camera = Self.exif(scene)
    camera.focalLength *= 1.05
    #expect(try Self.search(scene, camera: camera).cameras == [camera])
  }

  /// Pairs with too few matches are recorded with their number of matches and the number required.
  @Test func rejectedPairsAreRecorded() throws {
    let scene = Self.scene()
    let counts = try Self.search(scene, camera: Self.exif(scene)).viewGraph.pairs
      .map(\.matches.count).sorted()
    let needed = counts[counts.count / 2]
    var options = CorrespondenceSearch.Options()
    options.verification.minimumInliers = needed
    let graph = try CorrespondenceSearch(options).run(
      photos: scene.photos, cameras: [Self.exif(scene)], features: scene.features,
      ordering: .unordered, StageContext()
    ).viewGraph
    #expect(!graph.pairs.isEmpty && !graph.rejected.isEmpty)
    #expect(graph.rejected.allSatisfy { $0.matches > 0 && $0.matches < $0.needed })
    #expect(graph.rejected.allSatisfy { $0.needed >= needed })
    #expect(zip(graph.rejected, graph.rejected.dropFirst()).allSatisfy { $0.pair < $1.pair })
    #expect(Set(graph.pairs.map(\.pair)).isDisjoint(with: graph.rejected.map(\.pair)))
  }

  /// A photo that shares few matches with others is not left out if these agree, and its weak pairs
  /// are the only ones that are accepted.
  @Test(arguments: [16, 9])
  func weakPairsConnectPhotosWithoutPartners(shared: Int) throws {
    let scene = Self.scene(noise: 0.2)
    var features = scene.features
    let known = Set(scene.pointOfFeature[..<9].joined())
    let common = scene.pointOfFeature[9].indices
      .filter { known.contains(scene.pointOfFeature[9][$0]) }
    features[9] = features[9].selecting(Array(common.prefix(shared)))
    let graph = try CorrespondenceSearch().run(
      photos: scene.photos, cameras: [Self.exif(scene)], features: features,
      ordering: .unordered, StageContext()
    ).viewGraph
    let added = graph.pairs.filter { $0.pair.second.index == 9 }
    #expect(added.isEmpty == (shared < PairVerification.Options().weakMinimumInliers))
    for pair in added {
      #expect(pair.matches.count <= shared)
      for match in pair.matches {
        let point = scene.pointOfFeature[9][common[Int(match.second)]]
        #expect(point == scene.pointOfFeature[pair.pair.first.index][Int(match.first)])
      }
    }
    let others = graph.pairs.filter { $0.pair.second.index != 9 }
    #expect(others.allSatisfy { $0.matches.count >= PairVerification.Options().minimumInliers })
  }

  /// Weak pairs of photos with enough partners stay rejected.
  @Test func weakPairsOfConnectedPhotosAreRejected() throws {
    let scene = Self.scene()
    var options = CorrespondenceSearch.Options()
    options.expansion.minimumPartners = 0
    let counts = try Self.search(scene, camera: Self.exif(scene)).viewGraph.pairs
      .map(\.matches.count).sorted()
    options.verification.minimumInliers = counts[counts.count / 2]
    let graph = try CorrespondenceSearch(options).run(
      photos: scene.photos, cameras: [Self.exif(scene)], features: scene.features,
      ordering: .unordered, StageContext()
    ).viewGraph
    let weak = graph.rejected.compactMap(\.weak)
    let needed = options.verification.weakMinimumInliers
    #expect(!weak.isEmpty && weak.allSatisfy { $0.matches.count >= needed })
    #expect(Set(weak.map(\.pair)).isDisjoint(with: graph.pairs.map(\.pair)))
  }

  @Test func threadsDoNotMatter() throws {
    let scene = Self.scene(photos: 8)
    let one = try Self.search(scene, threads: 1)
    let two = try Self.search(scene, threads: 2)
    #expect(one.viewGraph.pairs == two.viewGraph.pairs && one.cameras == two.cameras)
  }

  @Test func unrelatedPhotosAreNotPaired() throws {
    let scene = Self.scene(photos: 12, secondComponentStart: 6)
    let graph = try Self.search(scene, camera: Self.exif(scene)).viewGraph
    // Each half of six photos is connected.
    for half in [0..<6, 6..<12] {
      #expect(graph.pairs.count { half.contains($0.pair.first.index) } >= 5)
    }
    #expect(graph.pairs.allSatisfy { ($0.pair.first.index < 6) == ($0.pair.second.index < 6) })
  }

  @Test func sequenceContainsLoopClosures() throws {
    let scene = Self.scene(photos: 40)
    let pairs = try PairSelection().run(scene.features, ordering: .sequential, StageContext()).pairs
    #expect(pairs == pairs.sorted() && Set(pairs).count == pairs.count)
    #expect((0..<39).allSatisfy { pairs.contains(PhotoPair(ID($0), ID($0 + 1))) })
    #expect(pairs.contains(PhotoPair(ID(0), ID(39))) && pairs.contains(PhotoPair(ID(1), ID(38))))
    #expect(pairs.count < 40 * 39 / 2)
  }

  @Test func fewPhotosAreAllPaired() throws {
    let scene = Self.scene(photos: 12, secondComponentStart: 6)
    let pairs = try PairSelection().run(scene.features, ordering: .unordered, StageContext())
      .pairs
    #expect(pairs.count == 66 && pairs == pairs.sorted())
  }

  @Test func emptyInputGivesAnEmptyGraph() throws {
    for count in [0, 1, 2] {
      let scene = Self.scene(photos: max(1, count))
      let context = StageContext()
      let result = try CorrespondenceSearch().run(
        photos: Array(scene.photos.prefix(count)), cameras: [scene.camera],
        features: Array(repeating: FeatureSet(), count: count),
        ordering: count == 2 ? .sequential : .unordered, context)
      #expect(result.viewGraph.pairs.isEmpty && result.viewGraph.photoCount == count)
      #expect(context.notes.warnings.isEmpty == (count < 2))
    }
  }

  @Test func canceledSearchThrows() throws {
    let scene = Self.scene(photos: 4)
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      _ = try CorrespondenceSearch().run(
        photos: scene.photos, cameras: [scene.camera], features: scene.features,
        ordering: .unordered, StageContext(control: KernelControl(flag: flag)))
    }
  }
}

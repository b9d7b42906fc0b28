import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Repeated structures of a scene are never superimposed without an error or a warning.
@Suite(.endToEnd, .serialized) struct SceneAmbiguityCheckTests {
  private func isReported(_ notes: StageNotes) -> Bool {
    notes.warnings.contains { $0.contains("similar parts of the scene") && $0.contains("view_") }
  }

  /// Expects a failure or a warning that names photos, or correct poses.
  private func expectNoUndetectedAmbiguity(_ scene: RenderedScene) throws {
    do {
      let aligned = try AlignedScene(scene)
      let poses = aligned.poses
      let isCorrect = poses.maximumCenterError < 0.02 && poses.maximumRotationError < 0.02
      #expect(isCorrect || isReported(aligned.notes))
    } catch let error as PipelineError {
      let reason = error.errorDescription ?? ""
      #expect(reason.contains("similar parts of the scene") && reason.contains("view_"))
    }
  }

  @Test(arguments: [3, 0]) func identicalSidesOfABoxAreReported(ballCount: Int) throws {
    try expectNoUndetectedAmbiguity(.twinBox(ballCount: ballCount))
  }

  @Test func unlinkedIdenticalSidesAreReported() throws {
    let scene = RenderedScene.twinBox()
    let poses = [14, 15, 0, 1, 2, 6, 7, 8, 9, 10].map { scene.poses[$0] }
    try expectNoUndetectedAmbiguity(scene.seen(from: poses))
  }

  @Test func identicalBaysOfAFacadeAreReported() throws {
    try expectNoUndetectedAmbiguity(.facade())
  }

  @Test func differentSidesAreConsistent() throws {
    let aligned = try AlignedScene(.twinBox(photoCount: 18, isRepeated: false))
    let notes = aligned.notes
    #expect(aligned.poses.count == 18)
    #expect(aligned.poses.maximumCenterError < 0.01)
    #expect(!isReported(notes))
    #expect(notes.counts["ambiguityConflicts"] == 0)
    #expect(notes.counts["contradictedPairs"] == 0)
  }

  /// The pattern folds the first map; the object before it does not repeat.
  @Test func patternsBehindAnObjectAreResolved() throws {
    let capture = CaptureScene.wallpaper(seed: 11, width: 720, photoCount: 40)
    let aligned = try AlignedScene(capture.scene(ofPhoto: 0))
    #expect(aligned.poses.count == 40)
    #expect(aligned.poses.maximumCenterError < 0.005)
    #expect(aligned.poses.maximumRotationError < 0.005)
    #expect(!isReported(aligned.notes))
    #expect(aligned.notes.details.contains { $0.contains("A pattern repeats") })
  }

  // MARK: Contradicted pairs

  @Test(arguments: [0.0, 0.2]) func correctMapsContradictNoPair(outliers: Double) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = 0.5
    options.outlierRatio = outliers
    let scene = SyntheticScene(options)
    let map = try SparseMapping().run(
      scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
      StageContext())
    #expect(map.registered.count == scene.photos.count)
    #expect(scene.viewGraph.contradicted(by: map, features: scene.features).isEmpty)
  }

  @Test func pairsOfAMisplacedPhotoContradict() throws {
    let scene = SyntheticScene()
    var map = try SparseMapping().run(
      scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
      StageContext())
    // The points of the photo stay where they were.
    map.poses[3] = map.poses[9]
    let bad = scene.viewGraph.contradicted(by: map, features: scene.features)
    let moved = scene.viewGraph.pairs.map(\.pair).count {
      $0.first.index == 3 || $0.second.index == 3
    }
    #expect(bad.contains { $0.second.index == 3 } && bad.count <= moved)
    #expect(bad.allSatisfy { $0.first.index == 3 || $0.second.index == 3 })
  }

  /// Opposite photos of a ball that match points of which no photo shows both: alike rows of
  /// windows on two sides of a house, if the pair is weak.
  @Test(arguments: [(share: 0.1, contradicts: false), (share: 0.3, contradicts: true)])
  func onlyStrongPairsContradictStrongChains(share: Double, contradicts: Bool) throws {
    let scene = SyntheticScene()
    let map = try SparseMapping().run(
      scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
      StageContext())
    let opposite = PhotoPair(ID(0), ID(6))
    var graph = scene.viewGraph
    let weakest = try #require(
      graph.pairs.filter { $0.pair.second.index == $0.pair.first.index + 1 }
        .map(\.matches.count).min())
    let matches = unlikeMatches(of: opposite, in: scene)
    let count = Int(share * Double(weakest))
    try #require(matches.count >= count && count > 5)
    graph.pairs.append(
      VerifiedPair(
        pair: opposite, model: .fundamental, secondFromFirst: nil,
        matches: Array(matches.prefix(count)), medianAngle: 0))
    var options = SceneAmbiguityCheck.Options()
    options.minimumPairMatches = 5
    let contradicted = graph.contradicted(by: map, features: scene.features, options)
    #expect(contradicted == (contradicts ? [opposite] : []))
  }

  /// Matches of points that no photo shows together.
  private func unlikeMatches(of pair: PhotoPair, in scene: SyntheticScene) -> [FeatureMatch] {
    var photosOfPoint = [Set<Int>](repeating: [], count: scene.points.count)
    for (photo, points) in scene.pointOfFeature.enumerated() {
      for point in points { photosOfPoint[Int(point)].insert(photo) }
    }
    var rest = Array(scene.pointOfFeature[pair.second.index].enumerated())
    return scene.pointOfFeature[pair.first.index].enumerated().compactMap { first, point in
      let other = rest.firstIndex {
        photosOfPoint[Int($0.element)].isDisjoint(with: photosOfPoint[Int(point)])
      }
      return other.map {
        FeatureMatch(first: Int32(first), second: Int32(rest.remove(at: $0).offset))
      }
    }
  }
}

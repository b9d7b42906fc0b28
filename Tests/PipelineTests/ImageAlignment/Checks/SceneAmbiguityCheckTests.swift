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
}

import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

/// Parts of a scene that look alike are never laid on each other without a word.
@Suite(.serialized) struct LookAlikeTests {
  private func isTold(_ notes: StageNotes) -> Bool {
    notes.warnings.contains { $0.contains("look alike") && $0.contains("view_") }
  }

  /// A failure that names photos, or a warning that does, or the right poses.
  private func expectNoSilentFold(_ scene: RenderedScene) throws {
    do {
      let aligned = try AlignedScene(scene)
      let poses = aligned.poses
      let isRight = poses.maximumCenterError < 0.02 && poses.maximumRotationError < 0.02
      #expect(isRight || isTold(aligned.notes))
    } catch let error as PipelineError {
      let reason = error.errorDescription ?? ""
      #expect(reason.contains("look alike") && reason.contains("view_"))
    }
  }

  @Test(arguments: [3, 0]) func likeSidesOfABoxAreTold(ballCount: Int) throws {
    try expectNoSilentFold(.twinBox(ballCount: ballCount))
  }

  @Test func likeSidesThatNoPhotoLinksAreTold() throws {
    let scene = RenderedScene.twinBox()
    let poses = [14, 15, 0, 1, 2, 6, 7, 8, 9, 10].map { scene.poses[$0] }
    try expectNoSilentFold(scene.seen(from: poses))
  }

  @Test func likeBaysOfAFacadeAreTold() throws { try expectNoSilentFold(.facade()) }

  @Test func differentSidesAreSound() throws {
    let aligned = try AlignedScene(.twinBox(photoCount: 18, isRepeated: false))
    let notes = aligned.notes
    #expect(aligned.poses.count == 18)
    #expect(aligned.poses.maximumCenterError < 0.01)
    #expect(!isTold(notes))
    #expect(notes.counts["lookAlikeConflicts"] == 0)
    #expect(notes.counts["contradictedPairs"] == 0)
  }

  // MARK: Pairs that contradict

  @Test(arguments: [0.0, 0.2]) func trueScenesContradictNoPair(outliers: Double) throws {
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
    // Its own points follow it nowhere.
    map.poses[3] = map.poses[9]
    let bad = scene.viewGraph.contradicted(by: map, features: scene.features)
    #expect(!bad.isEmpty)
    #expect(bad.allSatisfy { $0.first.index == 3 || $0.second.index == 3 })
  }
}

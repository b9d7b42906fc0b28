import Foundation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Photos that are hard to align: results are correct, and unusable photos are reported by name.
@Suite(.endToEnd, .serialized) struct HardSceneTests {
  /// Checks that every photo has a pose or a reason that contains its name.
  private func expectEveryPhotoIsReported(_ result: Reconstruction) {
    let missing = Set(result.unregistered.map(\.name))
    #expect(missing.count == result.photos.count - result.registered.count)
    for photo in result.unregistered {
      #expect(photo.fault == .notRegistered && photo.reason.hasPrefix(photo.name))
    }
    #expect(result.registered.allSatisfy { !missing.contains(result.photos[$0.index].name) })
  }

  @Test func unrelatedPhotosAreExcluded() throws {
    let outcome = try AlignedScene(
      .statue(photoCount: 12, upperCount: 4, width: 400, height: 300), unrelatedPhotos: 4)
    expectEveryPhotoIsReported(outcome.reconstruction)
    #expect(outcome.poses.count == 12)
    #expect(outcome.poses.maximumCenterError < 0.01)
    #expect(outcome.reconstruction.unregistered.count == 4)
    #expect(outcome.reconstruction.unregistered.allSatisfy { $0.name.hasPrefix("x_") })
    #expect(outcome.reconstruction.unregistered.allSatisfy { $0.reason.contains("no matches") })
  }

  @Test(arguments: [true, false]) func pureRotationIsRejected(hasMetadata: Bool) throws {
    let poses = (0..<6).map { index in
      let angle = 0.9 * (Double(index) / 5 - 0.5)
      return RigidTransform.lookingAt(
        [3 * sin(angle), 1.5 + 0.3 * cos(5 * angle), 4 - 4 * cos(angle)], from: [0, 1.5, 4])
    }
    let scene = RenderedScene.relief(width: 400, height: 300).seen(from: poses)
    let error = #expect(throws: PipelineError.self) {
      try AlignedScene(scene, hasMetadata: hasMetadata)
    }
    #expect(error?.errorDescription?.contains("one place") == true)
  }

  @Test func planeIsMapped() throws {
    let outcome = try AlignedScene(.plane(photoCount: 8, width: 400, height: 300))
    #expect(outcome.poses.count == 8)
    #expect(outcome.poses.maximumCenterError < 0.01)
    #expect(outcome.poses.maximumRotationError < 0.02)
  }
}

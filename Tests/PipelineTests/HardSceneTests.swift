import Foundation
import Kernels
import Pipeline
import SceneModel
import TestSupport
import Testing

/// Photos that are hard to align: what comes out is right, and what can't be used is named.
@Suite(.serialized) struct HardSceneTests {
  /// What alignment made of a folder of rendered photos.
  private struct Outcome {
    var reconstruction: Reconstruction
    /// Of the rendered photos that have a pose.
    var poses: PoseComparison
    var warnings: [String]
  }

  private func align(
    _ scene: RenderedScene, strangers: Int = 0, hasMetadata: Bool = true
  ) throws -> Outcome {
    var scene = scene
    scene.samplesPerSide = 1
    let folder = try TemporaryFolder()
    let control = KernelControl(threadCount: 2)
    try folder.write(
      try scene.photos(control), focalLength: hasMetadata ? scene.camera.focalLength.x : nil)
    let (width, height) = (scene.camera.width, scene.camera.height)
    for index in 0..<strangers {
      let stranger = TexturePattern.image(
        width: width, height: height, seed: UInt32(7919 * index + 5))
      try folder.write(
        [stranger], focalLength: scene.camera.focalLength.x, first: index, prefix: "x_")
    }
    let notes = StageNotes()
    let context = StageContext(control: control, notes: notes)
    let ingested = try PhotoIngestion().run(folder: folder.url, context)
    let images = ImageStore(
      photos: ingested.photos, byteBudget: 1 << 30, processingPixels: ingested.processingPixels)
    let reconstruction = try ImageAlignment().run(
      photos: ingested.photos, cameras: ingested.cameras, images: images, context)
    let estimated = scene.poses.indices.map { index in
      ingested.photos.first { $0.name == RenderedScene.name(index) }
        .flatMap { reconstruction.poses[$0.id.index] }
    }
    return Outcome(
      reconstruction: reconstruction,
      poses: PoseComparison(estimated: estimated, true: scene.poses), warnings: notes.warnings)
  }

  /// Every photo has a pose or a reason that names it.
  private func expectAccounts(_ result: Reconstruction) {
    let missing = Set(result.unregistered.map(\.name))
    #expect(missing.count == result.photos.count - result.registered.count)
    for photo in result.unregistered {
      #expect(photo.fault == .notRegistered && photo.reason.hasPrefix(photo.name))
    }
    #expect(result.registered.allSatisfy { !missing.contains(result.photos[$0.index].name) })
  }

  @Test func strangersAreLeftOut() throws {
    let outcome = try align(
      .statue(photoCount: 12, upperCount: 4, width: 400, height: 300), strangers: 4)
    expectAccounts(outcome.reconstruction)
    #expect(outcome.poses.count == 12)
    #expect(outcome.poses.maximumCenterError < 0.01)
    #expect(outcome.reconstruction.unregistered.count == 4)
    #expect(outcome.reconstruction.unregistered.allSatisfy { $0.name.hasPrefix("x_") })
    #expect(outcome.reconstruction.unregistered.allSatisfy { $0.reason.contains("no matches") })
  }

  @Test(arguments: [true, false]) func turningOnTheSpotGivesNoModel(hasMetadata: Bool) throws {
    let poses = (0..<6).map { index in
      let angle = 0.9 * (Double(index) / 5 - 0.5)
      return SyntheticScene.lookingAt(
        [3 * sin(angle), 1.5 + 0.3 * cos(5 * angle), 4 - 4 * cos(angle)], from: [0, 1.5, 4])
    }
    let scene = RenderedScene.relief(width: 400, height: 300).seen(from: poses)
    let error = #expect(throws: PipelineError.self) {
      try align(scene, hasMetadata: hasMetadata)
    }
    #expect(error?.errorDescription?.contains("one place") == true)
  }

  @Test func planeIsMapped() throws {
    let outcome = try align(.plane(photoCount: 8, width: 400, height: 300))
    #expect(outcome.poses.count == 8)
    #expect(outcome.poses.maximumCenterError < 0.01)
    #expect(outcome.poses.maximumRotationError < 0.02)
  }
}

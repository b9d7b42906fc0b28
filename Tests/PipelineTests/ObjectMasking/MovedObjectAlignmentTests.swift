import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Photos that cannot be aligned to one model of all sides.
@Suite(.endToEnd, .serialized) struct MovedObjectAlignmentTests {
  private let folder: TemporaryFolder
  private let control = KernelControl(threadCount: 2)
  private var photos: URL { folder.url.appendingPathComponent("photos") }

  init() throws {
    folder = try TemporaryFolder()
    try FileManager.default.createDirectory(at: photos, withIntermediateDirectories: true)
  }

  private func pipeline(
    _ configuration: PipelineConfiguration = PipelineConfiguration()
  ) -> ReconstructionPipeline {
    ReconstructionPipeline(.photos(in: photos), configuration: configuration)
  }

  private func write(_ images: [RasterImage], _ camera: Camera, prefix: String = "") throws {
    let parent = try TemporaryFolder()
    try parent.write(images, focalLength: camera.focalLength.x)
    for index in images.indices {
      let name = RenderedScene.name(index)
      try FileManager.default.moveItem(
        at: parent.url.appendingPathComponent(name),
        to: photos.appendingPathComponent(prefix + name))
    }
  }

  private func write(_ scene: RenderedScene, prefix: String = "") throws {
    var scene = scene
    scene.samplesPerSide = 1
    try write(try scene.photos(control), scene.camera, prefix: prefix)
  }

  private func write(_ capture: CaptureScene) throws {
    let images = try capture.views.indices.map {
      try capture.scene(ofPhoto: $0).photo($0, control)
    }
    try write(images, capture.camera)
  }

  /// Photos of another place are left out, but nothing was moved.
  @Test func photosOfAnotherSceneAreNoPlacement() throws {
    try write(
      DenseScene.rich.scene(
        width: 480, poses: DenseScene.arc(count: 12, stepDegrees: 12), fineness: 0.3))
    try write(RenderedScene.relief(photoCount: 6, width: 480, height: 360), prefix: "x_")
    let pipeline = pipeline()
    let result = try pipeline.align()
    let names = (0..<12).map(RenderedScene.name)
    #expect(result.registered.map { result.photos[$0.index].name } == names)
    #expect(
      result.unregistered.map(\.name).sorted() == (0..<6).map { "x_" + RenderedScene.name($0) })
    #expect(pipeline.report.concerns.isEmpty)
    let alignment = try #require(pipeline.report.stages.first { $0.name == "imageAlignment" })
    #expect(alignment.counts["joinedPlacements"] == nil)
  }

  /// An object without texture, turned by hand: the table connects the photos, the object doesn't.
  /// Either alignment fails, or the result is flagged.
  @Test(arguments: [UInt64(1), 2, 3]) func anObjectThatCannotBeAlignedIsReported(seed: UInt64)
    throws
  {
    try write(
      CaptureScene.loudspeaker(.hand, seed: seed, width: 480, photoCount: 14, fineness: 0.3))
    let pipeline = pipeline()
    do {
      _ = try pipeline.align()
      #expect(!pipeline.report.concerns.isEmpty)
    } catch is PipelineError {}
  }

  /// No alignment by the object has as many photos as are demanded, and the check of that by the
  /// surroundings is lenient.
  @Test func sidesThatAreNotJoinedAreReported() throws {
    try write(
      CaptureScene(
        .statue, .flip, .textured, seed: 5, width: 480, photoCount: 20, fineness: 0.3))
    var configuration = PipelineConfiguration()
    configuration.checkpointDirectory = folder.url.appendingPathComponent("work")
    configuration.movedObjects.join.minimumShare = 3
    configuration.movedObjects.join.acceptedLoss = 1
    configuration.alignment.sceneAmbiguity.minimumContradicted = .max
    let pipeline = pipeline(configuration)
    let result = try pipeline.align()
    #expect(result.registered.count >= 10)
    let concerns = pipeline.report.concerns.filter { $0.contains("sides could not be joined") }
    #expect(concerns.count == 1, "\(pipeline.report.concerns)")
    #expect(pipeline.report.warnings.filter(concerns.contains) == concerns)
    let alignment = try #require(pipeline.report.stages.first { $0.name == "imageAlignment" })
    #expect(alignment.counts["joinedPlacements"] == nil)
    // The masks of the placements are removed.
    let masks = folder.url.appendingPathComponent("work/masks").path
    let files = (try? FileManager.default.contentsOfDirectory(atPath: masks)) ?? []
    #expect(files.isEmpty)
  }
}

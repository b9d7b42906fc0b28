import Evaluation
import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Photos of an object that is turned over halfway, on a table with more texture than it has: one
/// model of all sides, compared with the exact cameras and masks.
@Suite(.endToEnd, .serialized) struct MovedObjectTests {
  private let capture = CaptureScene(
    .statue, .flip, .textured, seed: 5, width: 640, photoCount: 24, fineness: 0.5)
  private let folder: TemporaryFolder
  private var images: URL { folder.url.appendingPathComponent("images") }
  private var masks: URL { folder.url.appendingPathComponent("masks") }

  init() throws {
    folder = try TemporaryFolder()
    try FileManager.default.createDirectory(at: images, withIntermediateDirectories: true)
    var exif = ExifFields()
    let millimeters = 36 * capture.camera.focalLength.x / Double(capture.camera.width)
    exif.focalLengthIn35mmFilm = Int(millimeters.rounded())
    let control = KernelControl()
    for index in capture.views.indices {
      let photo = try ImageCodec.encodeJPEG(
        capture.scene(ofPhoto: index).photo(index, control), quality: 0.92)
      try Data(ExifWriter.jpeg(photo, with: exif))
        .write(to: images.appendingPathComponent(RenderedScene.name(index)))
    }
  }

  private func pipeline(
    checkpoint: String, threads: Int, configuration: PipelineConfiguration = PipelineConfiguration()
  ) -> ReconstructionPipeline {
    var configuration = configuration
    configuration.checkpointDirectory = folder.url.appendingPathComponent(checkpoint)
    configuration.threadCount = threads
    configuration.maskOutput = masks
    return ReconstructionPipeline(.photos(in: images), configuration: configuration)
  }

  private func model(_ pipeline: ReconstructionPipeline, _ name: String) throws -> Data {
    let output = folder.url.appendingPathComponent(name)
    try pipeline.writeModel(DetailSpecification(.preview), to: output)
    return try Data(contentsOf: output)
  }

  @Test func allSidesAreOneModel() throws {
    let first = pipeline(checkpoint: "work", threads: 2)
    let bytes = try model(first, "first.usdz")
    let alignment = try #require(first.report.stages.first { $0.name == "imageAlignment" })
    #expect(alignment.counts["joinedPlacements"] == 2)
    #expect(first.report.concerns.isEmpty)
    try checkPoses(first.align())
    try checkMasks()
    first.releaseCheckpoint()

    // Any number of threads, and what remains of a run that was stopped, give the same bytes.
    #expect(try model(pipeline(checkpoint: "other", threads: 1), "other.usdz") == bytes)
    #expect(try resumed(without: ["mesh/surface.ply"], reusesAlignment: true) == bytes)
    let lost = ["masks/view_03.png", "mesh/surface.ply"]
    #expect(try resumed(without: lost, reusesAlignment: false) == bytes)
  }

  /// The photos have so few features of the object that more are extracted from what the masks
  /// leave. Those at hand join its sides as well.
  @Test func featuresAtHandJoinTheSides() throws {
    func features(_ pipeline: ReconstructionPipeline) throws -> Double {
      try checkPoses(pipeline.align())
      let alignment = try #require(pipeline.report.stages.first { $0.name == "imageAlignment" })
      #expect(alignment.counts["joinedPlacements"] == 2)
      return try #require(alignment.counts["features"])
    }
    var configuration = PipelineConfiguration()
    configuration.alignment.features.sparseFeatures = 0
    let atHand = try features(
      pipeline(checkpoint: "at hand", threads: 2, configuration: configuration))
    let extracted = try features(pipeline(checkpoint: "extracted", threads: 2))
    #expect(extracted < atHand)
  }

  /// The model of a run in the first checkpoint directory without some of its files.
  private func resumed(without names: [String], reusesAlignment: Bool) throws -> Data {
    let work = folder.url.appendingPathComponent("work")
    for name in names {
      try FileManager.default.removeItem(at: work.appendingPathComponent(name))
    }
    // Whatever is sealed again is another file.
    func sealedFile() throws -> NSNumber? {
      let file = work.appendingPathComponent("stages/alignment")
      return try FileManager.default.attributesOfItem(atPath: file.path)[.systemFileNumber]
        as? NSNumber
    }
    let (before, resumed) = (try sealedFile(), pipeline(checkpoint: "work", threads: 2))
    let bytes = try model(resumed, "resumed.usdz")
    #expect(try (sealedFile() == before) == reusesAlignment)
    resumed.releaseCheckpoint()
    return bytes
  }

  private func checkPoses(_ reconstruction: Reconstruction) throws {
    let truth = capture.views.enumerated().map { index, view in
      NamedCamera(
        name: RenderedScene.name(index), camera: capture.camera,
        cameraFromWorld: view.cameraFromObject)
    }
    let (errors, _) = try PoseErrors.comparing(
      NamedCamera.cameras(of: reconstruction), with: truth)
    #expect(errors.registered == capture.views.count)
    #expect(errors.centerRMSE < 0.002 && errors.rotationMeanDegrees < 0.2)
  }

  private func checkMasks() throws {
    let agreement = try capture.views.indices.map { index in
      let name = RenderedScene.name(index).replacingOccurrences(of: ".jpg", with: ".png")
      let file = try Data(contentsOf: masks.appendingPathComponent(name))
      return try MaskImage.decode(Array(file))
        .intersectionOverUnion(with: capture.scene(ofPhoto: index).mask(index))
    }
    #expect(agreement.reduce(0, +) / Double(agreement.count) > 0.95)
  }
}

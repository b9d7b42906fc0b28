import Evaluation
import Formats
import Foundation
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Photos in, USDZ out, compared with the exact cameras and surface of a rendered set.
@Suite(.endToEnd, .serialized) struct EndToEndTests {
  @Test func orbitIsReconstructed() throws {
    let folder = try TemporaryFolder()
    var configuration = PipelineConfiguration()
    configuration.checkpointDirectory = folder.url.appendingPathComponent("checkpoint")
    let pipeline = ReconstructionPipeline(
      .photos(in: Fixtures.images(of: "orbit")), configuration: configuration)
    let preview = DetailSpecification(.preview)
    let output = folder.url.appendingPathComponent("orbit.usdz")
    try pipeline.writeModel(preview, to: output)

    let reconstruction = try pipeline.align()
    #expect(reconstruction.registered.count == 20)
    #expect(reconstruction.meanReprojectionError < 0.5)

    let truth = Fixtures.folder("orbit").appendingPathComponent("gt")
    let cameras = try NamedCamera.cameras(
      json: Data(contentsOf: truth.appendingPathComponent("cameras.json")))
    let (errors, alignment) = try PoseErrors.comparing(
      NamedCamera.cameras(of: reconstruction), with: cameras)
    #expect(errors.centerRMSE < 0.001)

    let reference = try PLY.readMesh(truth.appendingPathComponent("mesh.ply"))
    let comparison = SurfaceComparison()
    let scores = try comparison.run(
      try pipeline.surface(for: preview), alignment,
      reference: comparison.reference(reference, cameras: cameras))
    let atTwoMillimeters = try #require(scores.thresholds.first { $0.threshold == 0.002 })
    #expect(atTwoMillimeters.fScore > 0.8)

    for name in ["sparse/images.txt", "dense/points.ply", "mesh/surface.ply", "report.json"] {
      let file = folder.url.appendingPathComponent("checkpoint/\(name)")
      #expect(FileManager.default.fileExists(atPath: file.path), "\(name) is missing")
    }
    #expect(try Data(contentsOf: output).prefix(4) == Data([0x50, 0x4b, 3, 4]))
    try savedRunProducesTheSameModel(folder.url, output)
    let other = ReconstructionPipeline(
      .photos(in: Fixtures.images(of: "orbit")), configuration: configuration)
    #expect(throws: CheckpointError.self) { try other.ingest() }
    pipeline.releaseCheckpoint()
    #expect(try other.ingest().photos.count == 20)
    #expect(throws: CheckpointError.self) { try pipeline.ingest() }
  }

  @Test func resultsOfAnEarlierRunAreReused() throws {
    let folder = try TemporaryFolder()
    var configuration = PipelineConfiguration()
    configuration.checkpointDirectory = folder.url.appendingPathComponent("checkpoint")
    func run(_ name: String) throws -> (model: Data, report: RunReport) {
      let output = folder.url.appendingPathComponent(name)
      let pipeline = ReconstructionPipeline(
        .photos(in: Fixtures.images(of: "orbit")), configuration: configuration)
      try pipeline.writeModel(DetailSpecification(.preview), to: output)
      return (try Data(contentsOf: output), pipeline.report)
    }
    let first = try run("first.usdz")
    let second = try run("second.usdz")
    #expect(second.model == first.model)
    #expect(!second.report.stages.map(\.name).contains("pointCloudGeneration"))
    #expect(second.report.warnings == first.report.warnings)
    #expect(second.report.meanReprojectionError == first.report.meanReprojectionError)
    // Without the surface, and with a damaged alignment.
    let checkpoint = folder.url.appendingPathComponent("checkpoint")
    try FileManager.default.removeItem(at: checkpoint.appendingPathComponent("mesh/surface.ply"))
    let alignment = checkpoint.appendingPathComponent("stages/alignment")
    try Data(contentsOf: alignment).dropLast(100).write(to: alignment)
    let third = try run("third.usdz")
    #expect(third.model == first.model)
    #expect(third.report.stages.map(\.name).contains("pointCloudGeneration"))
  }

  private func savedRunProducesTheSameModel(_ folder: URL, _ output: URL) throws {
    let saved = try SavedRun(checkpoint: folder.appendingPathComponent("checkpoint"))
    let pipeline = ReconstructionPipeline(
      .savedRun(saved), configuration: PipelineConfiguration())
    let again = folder.appendingPathComponent("again.usdz")
    try pipeline.writeModel(DetailSpecification(.preview), to: again)
    #expect(try Data(contentsOf: again) == Data(contentsOf: output))
    let stages = pipeline.report.stages.map(\.name)
    #expect(stages == ["preProcessing", "textureMapping", "optimization"])
  }

  @Test func threadsDoNotChangeTheFile() throws {
    let folder = try TemporaryFolder()
    let files = try [1, 2].map { threads in
      var configuration = PipelineConfiguration()
      configuration.threadCount = threads
      configuration.isObjectMaskingEnabled = false
      var specification = DetailSpecification(.preview)
      specification.viewPixels = 60_000
      let output = folder.url.appendingPathComponent("relief\(threads).usdz")
      try ReconstructionPipeline(
        .photos(in: Fixtures.images(of: "relief")), configuration: configuration
      ).writeModel(specification, to: output)
      return try Data(contentsOf: output)
    }
    #expect(files[0] == files[1])
  }
}

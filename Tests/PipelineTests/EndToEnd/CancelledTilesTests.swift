import Foundation
import Kernels
import Pipeline
import TestLevels
import TestSupport
import Testing

@Suite(.endToEnd) struct CancelledTilesTests {
  /// Canceled while what the tiles are made from is being made, and while they are.
  @Test(arguments: [PipelineStage.pointCloudGeneration, .meshGeneration, .optimization])
  func aRunWithTilesStops(in stage: PipelineStage) throws {
    let folder = try TemporaryFolder()
    var configuration = PipelineConfiguration()
    configuration.tiles = TileOutput(
      folder: folder.url.appendingPathComponent("tiles"), fileExtension: "glb")
    let flag = CancellationFlag()
    let pipeline = ReconstructionPipeline(
      .photos(in: Fixtures.images(of: "orbit")), configuration: configuration, flag: flag
    ) { event in
      if case .progress(stage, let fraction) = event, fraction > 0.2 { flag.cancel() }
    }
    let model = folder.url.appendingPathComponent("orbit.usdz")
    #expect(throws: CancellationError.self) {
      try pipeline.writeModel(DetailSpecification(.preview), to: model)
    }
    let index = folder.url.appendingPathComponent("tiles/tiles.json")
    #expect(!FileManager.default.fileExists(atPath: index.path))
  }
}

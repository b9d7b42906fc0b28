import Foundation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Tiles are canceled while what they are made from is being made, and while they are.
@Suite(.endToEnd) struct CancelledTilesTests {
  private let folder: TemporaryFolder
  private let preview = DetailSpecification(.preview)
  private var configuration = PipelineConfiguration()

  init() throws {
    folder = try TemporaryFolder()
    configuration.tiles = TileOutput(
      folder: folder.url.appendingPathComponent("tiles"), fileExtension: "glb")
  }

  private func pipeline(
    canceledIn stage: PipelineStage, _ access: CheckpointAccess = .exclusive
  ) -> ReconstructionPipeline {
    let flag = CancellationFlag()
    return ReconstructionPipeline(
      .photos(in: Fixtures.images(of: "orbit")), configuration: configuration,
      checkpointAccess: access, flag: flag
    ) { event in
      if case .progress(stage, let fraction) = event, fraction > 0.2 { flag.cancel() }
    }
  }

  @Test(arguments: [PipelineStage.meshGeneration, .optimization])
  func aRunStops(in stage: PipelineStage) throws {
    let model = folder.url.appendingPathComponent("orbit.usdz")
    #expect(throws: CancellationError.self) {
      try pipeline(canceledIn: stage).writeModel(preview, to: model)
    }
    let index = folder.url.appendingPathComponent("tiles/tiles.json")
    #expect(!FileManager.default.fileExists(atPath: index.path))
  }

  /// Parts that find nothing of those before them, and make it.
  @Test(arguments: [PipelineStage.pointCloudGeneration, .meshGeneration])
  mutating func aPartStops(in stage: PipelineStage) throws {
    configuration.checkpointDirectory = folder.url.appendingPathComponent("checkpoint")
    for part in [RunPart.tileBase, .surface, .tiles(.tileSurfaces, Block(index: 0, of: 1))] {
      #expect(throws: CancellationError.self) {
        try pipeline(canceledIn: stage, .parts).make(part, for: preview, in: ModelGeometry())
      }
    }
  }
}

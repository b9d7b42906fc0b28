import Formats
import Foundation
import ImageFiles
import Pipeline
import SceneModel
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

/// Checks before a run apply the limits of the machine's memory, as the run does.
@Suite struct MachineLimitTests {
  /// A photo with more pixels per side than a machine with 4 GiB accepts.
  private func folder() throws -> TemporaryFolder {
    let folder = try TemporaryFolder()
    let image = TexturePattern.image(width: 8200, height: 240, seed: 1)
    try folder.write(ImageCodec.encodeJPEG(image, quality: 0.9), as: "photos/wide.jpg")
    return folder
  }

  private func refusals(_ folder: URL, memory: Int) throws -> [RejectedPhoto.Fault] {
    let photos = folder.appendingPathComponent("photos")
    let model = folder.appendingPathComponent("model.usdz").path
    let output = try ModelOutput(model, formats: ModelFormat.files)
    return try Machine.$override.withValue(Machine(totalMemoryBytes: memory)) {
      try DryRun(.parse([photos.path, model]), photos: photos, output: output)
        .report.refused.map(\.fault)
    }
  }

  @Test func aDryRunRefusesWhatTheRunRefuses() throws {
    let folder = try folder()
    #expect(try refusals(folder.url, memory: 4 << 30) == [.tooLarge])
    #expect(try refusals(folder.url, memory: 16 << 30) == [])
  }

  @Test(arguments: [(4 << 30, 0), (16 << 30, 1)])
  func aRunRefusesTheSame(memory: Int, accepted: Int) throws {
    let folder = try folder()
    let pipeline = ReconstructionPipeline(
      .photos(in: folder.url.appendingPathComponent("photos")),
      configuration: PipelineConfiguration(machine: Machine(totalMemoryBytes: memory)))
    let error = #expect(throws: PipelineError.self) { try pipeline.ingest() }
    let expected: PipelineError =
      accepted == 0
      ? .noPhotos(folder: folder.url.appendingPathComponent("photos").path, rejected: 1)
      : .tooFewPhotos(found: 1, needed: PipelineError.minimumPhotos)
    #expect(error == expected)
  }
}

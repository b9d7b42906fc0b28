import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// The survey of `inspect --overlap` predicts the view graph of a run with the same options.
@Suite(.endToEnd) struct OverlapSurveyTests {
  /// Photos of an object on a turntable, in front of a still background with more texture.
  private let capture = CaptureScene(
    .statue, .turntable, .textured, seed: 5, width: 480, photoCount: 10, fineness: 0.3)
  private let folder: TemporaryFolder

  init() throws {
    folder = try TemporaryFolder()
    for index in capture.views.indices {
      try folder.write(
        try ImageCodec.encodeJPEG(capture.scene(ofPhoto: index).photo(index), quality: 0.95),
        as: "photos/\(RenderedScene.name(index))")
    }
  }

  /// Writes the masks of some photos next to them.
  private func writeMasks(of photos: [Int]) throws {
    for index in photos {
      let name = RenderedScene.name(index).replacingOccurrences(of: ".jpg", with: "_mask.png")
      try folder.write(
        try ImageCodec.encodePNG(capture.scene(ofPhoto: index).mask(index)), as: "photos/\(name)")
    }
  }

  /// The view graph in numbers.
  private static let counts = [
    "candidatePairs", "pairs", "matches", "verifiedPairs", "verifiedMatches", "twoMotionPairs",
  ]

  private func countsOfSurvey(
    _ configuration: PipelineConfiguration
  ) throws -> [String: Double] {
    let ingested = try PhotoIngestion(configuration.ingestion).run(
      folder: folder.url.appendingPathComponent("photos"), StageContext())
    let images = ImageStore(
      photos: ingested.photos, byteBudget: configuration.imageMemory,
      processingPixels: ingested.processingPixels)
    let notes = StageNotes()
    let result = try OverlapSurvey(configuration.alignmentOptions(for: images)).run(
      photos: ingested.photos, cameras: ingested.cameras, images: images,
      StageContext(notes: notes))
    let partners = result.overlaps.reduce(0) { $0 + $1.partners.count }
    #expect(Double(partners) == 2 * (notes.counts["verifiedPairs"] ?? 0))
    return notes.counts
  }

  /// What a run records, whether or not it aligns the photos.
  private func countsOfRun(_ configuration: PipelineConfiguration) -> [String: Double] {
    let pipeline = ReconstructionPipeline(
      .photos(in: folder.url.appendingPathComponent("photos")), configuration: configuration)
    _ = try? pipeline.align()
    return pipeline.report.stages.first { $0.name == "imageAlignment" }?.counts ?? [:]
  }

  @Test(arguments: [FeatureSensitivity.normal, .high])
  func surveyEqualsTheGraphOfARunWithMasks(sensitivity: FeatureSensitivity) throws {
    // Two photos without masks match in the background.
    try writeMasks(of: [0, 1, 2])
    var configuration = PipelineConfiguration()
    configuration.threadCount = 2
    configuration.alignment.features.sensitivity = sensitivity
    configuration.alignment.ordering = .sequential
    let (survey, run) = (try countsOfSurvey(configuration), countsOfRun(configuration))
    for name in Self.counts { #expect(survey[name] == run[name], "\(name)") }
    #expect(survey["twoMotionPairs"] == 0 && (survey["verifiedPairs"] ?? 0) > 0)
    // Without masks, the object is separated from the background.
    configuration.ingestion.inspection.usesMasks = false
    #expect(try countsOfSurvey(configuration)["twoMotionPairs"] ?? 0 > 0)
  }
}

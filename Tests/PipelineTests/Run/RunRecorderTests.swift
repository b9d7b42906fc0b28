import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct RunRecorderTests {
  private let events = Locked<[String]>([])

  private func recorder(flag: CancellationFlag = CancellationFlag()) -> RunRecorder {
    RunRecorder(PipelineConfiguration(), flag: flag) { [events] event in
      events.withLock { $0.append(Self.name(event)) }
    }
  }

  private static func name(_ event: PipelineEvent) -> String {
    switch event {
    case .progress(let stage, let fraction): "\(stage.rawValue) \(fraction)"
    case .extended(let stage, let factor): "\(stage.rawValue) x \(factor)"
    case .ingested(let photos): "ingested \(photos.count)"
    case .rejected(let photo): "refused \(photo.name)"
    case .downsampled: "downsampled"
    case .stitchingIncomplete(let registered, let all): "stitched \(registered) of \(all)"
    case .warning(let sentence): "warning \(sentence)"
    case .detail(let sentence): "detail \(sentence)"
    }
  }

  @Test func aStageThatGrowsSaysSo() throws {
    let recorder = recorder()
    try recorder.run(.imageAlignment) { context in
      try context.part(from: 0, to: 0.8).control.step(1)
      try context.extended(by: 2, after: 0.8).control.step(0.5)
    }
    #expect(
      events.withLock { $0 } == [
        "imageAlignment 0.0", "imageAlignment 0.8", "imageAlignment x 2.0", "imageAlignment 0.7",
        "imageAlignment 1.0",
      ])
  }

  @Test func aStageSendsProgressThenItsNotes() throws {
    let recorder = recorder()
    let store = ImageStore(images: [TexturePattern.image(width: 40, height: 30, seed: 1)])
    let value = try recorder.run(.meshGeneration, images: store) { context in
      context.notes.record("triangles", 12)
      context.notes.warn("A.")
      context.notes.log("B.")
      for _ in 0..<2 { _ = try store.image(ID(0)) }
      return 7
    }
    #expect(value == 7)
    #expect(
      events.withLock { $0 }
        == ["meshGeneration 0.0", "meshGeneration 1.0", "warning A.", "detail B."])
    let stage = try #require(recorder.report.stages.first)
    // The store caches nothing.
    #expect(stage.counts == ["triangles": 12, "decodedPhotos": 2])
    #expect(stage.name == "meshGeneration" && stage.seconds >= 0)
    #expect(recorder.report.warnings == ["A."] && recorder.report.details == ["B."])
    #expect(recorder.notes[.meshGeneration]?.counts == stage.counts)
  }

  @Test func aFailureIsInTheReportOnce() {
    let recorder = recorder()
    for _ in 0..<2 {
      #expect(throws: PipelineError.emptyCrop) {
        try recorder.run(.textureMapping) { _ in throw PipelineError.emptyCrop }
      }
    }
    let error = PipelineError.emptyCrop
    let sentences = [error.errorDescription, error.recoverySuggestion].compactMap(\.self)
    #expect(recorder.report.errors == [sentences.joined(separator: " ")])
    #expect(recorder.report.stages.count == 2)
  }

  /// The report of a run without a model shows which photos match.
  @Test func matchesAreInTheReportOfAFailure() throws {
    let recorder = recorder()
    let scene = SphereScene(viewCount: 4, imageSize: 64) { _ in SIMD3(120, 130, 140) }
    try recorder.record(
      IngestedPhotos(
        photos: scene.reconstruction.photos, cameras: scene.reconstruction.cameras, rejected: [],
        files: [], rejectedMasks: [], contentHashes: [1, 2, 3, 4], processingPixels: 1000,
        isDownsampled: false),
      folder: URL(filePath: "/photos"), minimumPhotos: PipelineError.minimumPhotos)
    var matches = MatchRecord()
    matches.features = [40, 30, 20, 10]
    (matches.first, matches.second) = ([1, 2], [2, 3])
    (matches.matches, matches.needed, matches.degrees) = ([15, 6], [0, 12], [4, 0])
    let error = PipelineError.alignmentFailed(reason: "no two photos show the same surface.")
    #expect(throws: error) {
      try recorder.run(.imageAlignment) { context in
        context.notes.record(matches)
        throw error
      }
    }
    let report = recorder.report
    #expect(report.matches?.pairs == matches)
    #expect(report.matches?.photos == scene.reconstruction.photos.map(\.name))
    #expect(report.photos.map(\.features) == [40, 30, 20, 10])
    #expect(report.photos.map(\.partners) == [0, 1, 1, 0])
    #expect(report.photos.map(\.group) == [1, 0, 0, 2])
    #expect(report.photos.allSatisfy { $0.status == .notRegistered && $0.observations == nil })
    recorder.record(scene.reconstruction)
    #expect(recorder.report.photos.allSatisfy { $0.status == .registered && $0.features != nil })
  }

  @Test func aCanceledRunStartsNoStage() {
    let flag = CancellationFlag()
    flag.cancel()
    let recorder = recorder(flag: flag)
    #expect(throws: CancellationError.self) {
      try recorder.run(.imageAlignment) { _ in Issue.record("the stage ran") }
    }
    #expect(recorder.report.stages.isEmpty && recorder.report.errors.count == 1)
  }

  @Test func tooFewPhotosAreReportedAfterTheirNumber() {
    let recorder = recorder()
    let scene = SphereScene(viewCount: 2, imageSize: 64) { _ in SIMD3(120, 130, 140) }
    var photos = IngestedPhotos(
      photos: scene.reconstruction.photos, cameras: scene.reconstruction.cameras,
      rejected: [
        RejectedPhoto(sampleID: 2, name: "c.txt", fault: .unsupportedFormat, reason: "No photo.")
      ], files: [], rejectedMasks: [], contentHashes: [1, 2], processingPixels: 1000,
      isDownsampled: true)
    func record() throws {
      try recorder.record(
        photos, folder: URL(filePath: "/photos"), minimumPhotos: PipelineError.minimumPhotos)
    }
    #expect(throws: PipelineError.tooFewPhotos(found: 2, needed: 3)) { try record() }
    #expect(events.withLock { $0 } == ["refused c.txt", "downsampled", "ingested 2"])
    #expect(recorder.report.photos.map(\.status) == [.rejected, .notRegistered, .notRegistered])
    photos.photos = []
    #expect(throws: PipelineError.noPhotos(folder: "/photos", rejected: 1)) { try record() }
  }
}

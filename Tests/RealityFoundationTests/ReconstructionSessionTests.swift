import Foundation
import TestLevels
import TestSupport
import Testing

@testable import Pipeline
@testable import RealityFoundation

/// Sessions with the real engine on rendered photos.
@Suite(.endToEnd, .serialized, .timeLimit(.minutes(15))) struct ReconstructionSessionTests {
  typealias Session = PhotogrammetrySession
  typealias Output = Session.Output

  private func results(in outputs: [Output]) -> [Session.Request: Session.Result] {
    outputs.reduce(into: [:]) { results, output in
      if case .requestComplete(let request, let result) = output { results[request] = result }
    }
  }

  @Test func allResultsShareOneFrame() async throws {
    let session = try Session(input: Fixtures.images(of: "orbit"))
    session.engineOptions.threadCount = 2
    let outputs = try await run(session, [.poses, .pointCloud])
    #expect(errors(in: outputs).isEmpty && outputs.map(name(of:)).contains("inputComplete"))
    let first = results(in: outputs)
    guard case .poses(let poses) = first[.poses], case .pointCloud(let cloud) = first[.pointCloud]
    else {
      Issue.record("a result is missing")
      return
    }
    #expect(poses.posesBySample.count == 20 && cloud.points.count > 1000)
    #expect(poses.urlsBySample[0]?.lastPathComponent == "view_00.jpg")
    #expect(cloud.points.allSatisfy { $0.color.w == 255 })
    // All cameras look from outside at the center of the points.
    let box = cloud.points.reduce(into: BoundingBox.empty) { $0.formUnion($1.position) }
    for pose in poses.posesBySample.values {
      let view = pose.rotation.act([0, 0, -1])
      #expect(dot(view, normalize(box.center - pose.translation)) > 0.8)
    }
    try await expectModelFromEarlierResults(session, box)
    try await expectCroppedAndTransformedEntities(session)
  }

  /// Requests the upper half of the model, scaled by two, and the whole model.
  private func expectCroppedAndTransformedEntities(_ session: Session) async throws {
    let whole = Session.Request.modelEntity(detail: .preview)
    guard case .modelEntity(let entity) = results(in: try await run(session, [whole]))[whole] else {
      Issue.record("the entity is missing")
      return
    }
    let model = try #require(entity.model)
    let bounds = model.mesh.bounds
    #expect(entity.visualBounds(relativeTo: nil) == bounds && model.materials.count == 1)
    let material = try #require(model.materials.first as? PhysicallyBasedMaterial)
    #expect(material.baseColor.texture?.resource.width == 1024)
    #expect(material.normal.texture != nil && material.ambientOcclusion.texture != nil)
    let upper = BoundingBox(min: [-9, bounds.center.y, -9], max: [9, 9, 9])
    let larger = Transform(scale: [2, 2, 2], translation: [0, 1, 0])
    let outside = BoundingBox(min: [50, 50, 50], max: [51, 51, 51])
    let half = Session.Request.modelEntity(
      detail: .preview, geometry: .init(bounds: upper, transform: larger))
    let nothing = Session.Request.modelEntity(
      detail: .preview, geometry: .init(bounds: outside))
    let outputs = try await run(session, [half, nothing])
    guard case .modelEntity(let cut) = results(in: outputs)[half], let mesh = cut.model?.mesh else {
      Issue.record("the cropped entity is missing")
      return
    }
    #expect(abs(mesh.bounds.min.y - (2 * bounds.center.y + 1)) < 0.01 * bounds.extents.y)
    #expect(abs(mesh.bounds.max.y - (2 * bounds.max.y + 1)) < 0.05 * bounds.extents.y)
    let part = try #require(mesh.contents.models.first?.parts.first)
    #expect(part.triangleIndices.map { $0.count % 3 == 0 && $0.count > 3000 } == true)
    #expect((errors(in: outputs).first as? ProcessingError)?.code == .emptyCrop)
  }

  /// A second call makes a model from the results of the first.
  private func expectModelFromEarlierResults(_ session: Session, _ box: BoundingBox) async throws {
    try await withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("model.usdz")
      let model = Session.Request.modelFile(url: url, detail: .preview)
      let outputs = try await run(session, [model, .bounds])
      #expect(errors(in: outputs).isEmpty && !outputs.map(name(of:)).contains("inputComplete"))
      guard case .bounds(let bounds) = results(in: outputs)[.bounds] else {
        Issue.record("the bounds are missing")
        return
      }
      #expect(length(bounds.center - box.center) < box.boundingRadius && !bounds.isEmpty)
      #expect(try Data(contentsOf: url).starts(with: Array("PK".utf8)))
      let stages = try #require(session.report).stages.map(\.name)
      #expect(stages.filter { $0 == PipelineStage.imageAlignment.rawValue }.count == 1)
      #expect(stages.filter { $0 == PipelineStage.pointCloudGeneration.rawValue }.count <= 2)
    }
  }

  /// How long the engine takes to stop is measured by `CancelBenchmark`.
  @Test func canceledEngineDeliversNoResult() async throws {
    let session = try Session(input: Fixtures.images(of: "relief"))
    session.engineOptions.threadCount = 2
    let outputs = try await withTaskExecutorPreference(QueueExecutor()) {
      try session.process(requests: [.poses])
      for try await output in session.outputs where name(of: output) == "requestProgress" { break }
      session.cancel()
      return try await outputsUntilEnd(session.outputs)
    }
    let names = outputs.map(name(of:))
    #expect(names.last == "processingCancelled" && !names.contains("requestComplete"))
    #expect(!session.isProcessing)
  }

  @Test func badPhotosAreReported() async throws {
    let session = try Session(input: Fixtures.folder("bad"))
    let outputs = try await run(session, [.poses])
    let reasons = outputs.compactMap { output -> String? in
      if case .invalidSample(_, let reason) = output { reason } else { nil }
    }
    #expect(reasons.contains { $0.contains("notes.txt") && $0.hasSuffix(".") })
    #expect(reasons.contains { $0.contains("blurred.jpg") } && reasons.count >= 5)
    #expect(errors(in: outputs).count == 1)
    #expect(name(of: try #require(outputs.last)) == "processingComplete")
  }

  @Test func foldersWithoutPhotosAreAnError() async throws {
    try await withTemporaryFolder { folder in
      try Data("text".utf8).write(to: folder.appendingPathComponent("a.jpg"))
      let outputs = try await run(try Session(input: folder), [.bounds, .poses])
      #expect(
        outputs.map(name(of:)).filter { !$0.hasPrefix("requestProgress") } == [
          "invalidSample", "requestError", "requestError", "processingComplete",
        ])
      let error = try #require(errors(in: outputs).first)
      #expect(sentence(of: error).contains(folder.path) && sentence(of: error).contains("JPEG"))
    }
  }
}

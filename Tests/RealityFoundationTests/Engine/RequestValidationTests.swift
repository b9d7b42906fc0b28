import Formats
import Foundation
import TestSupport
import Testing

@testable import RealityFoundation

@Suite struct RequestValidationTests {
  typealias Session = PhotogrammetrySession

  private func check(
    _ requests: [Session.Request], in folder: URL, checkpoint: URL? = nil, free: Int64 = .max
  ) throws {
    var configuration = Session.Configuration()
    configuration.checkpointDirectory = checkpoint
    let validation = RequestValidation(
      input: .folder(folder), configuration: configuration, options: EngineOptions(),
      freeBytes: { _ in free })
    try validation.check(requests)
  }

  private func isInvalidOutput(_ error: any Error) -> Bool {
    if case Session.Error.invalidOutput = error { true } else { false }
  }

  @Test func theURLSelectsTheKindOfOutput() throws {
    try withTemporaryFolder { folder in
      let file = folder.appendingPathComponent("model.usdz")
      #expect((OutputLocation(file)) == .file(file))
      let upper = folder.appendingPathComponent("MODEL.USDZ")
      #expect((OutputLocation(upper)) == .file(upper))
      #expect((OutputLocation(folder)) == .folder(folder))
      let new = folder.appendingPathComponent("a/b", isDirectory: true)
      #expect((OutputLocation(new)) == .folder(new))
      let glb = folder.appendingPathComponent("model.glb")
      #expect(OutputLocation(glb) == nil)
      #expect((OutputLocation(glb, additionalFormats: [.glb])) == .file(glb))
      #expect(OutputLocation(glb, additionalFormats: [.ply]) == nil)
    }
  }

  @Test func invalidGeometriesAreRejected() throws {
    typealias Geometry = Session.Request.Geometry
    var flat = Transform.identity
    flat.scale.y = 0
    var far = Transform.identity
    far.scale.x = .infinity
    let wrong = [
      Geometry(transform: flat), Geometry(transform: far),
      Geometry(bounds: BoundingBox(min: [0, 1, 0], max: [1, 0, 1])),
      Geometry(bounds: BoundingBox(min: [0, .nan, 0], max: [1, 1, 1])),
      Geometry(orientedBounds: OrientedBoundingBox(orientation: simd_quatf(vector: .zero))),
    ]
    try withTemporaryFolder { folder in
      try Data().write(to: folder.appendingPathComponent("a.jpg"))
      let file = folder.appendingPathComponent("model.usdz")
      for geometry in wrong {
        for request in [
          Session.Request.modelFile(url: file, geometry: geometry),
          .modelEntity(geometry: geometry),
        ] {
          let error = #expect(throws: ProcessingError.self) { try check([request], in: folder) }
          #expect(error?.code == .invalidRequest && error?.remedy.isEmpty == false)
        }
      }
      let open = BoundingBox(
        min: SIMD3(repeating: -.greatestFiniteMagnitude), max: [.infinity, 1, 1])
      try check([.modelFile(url: file, geometry: Geometry(bounds: open))], in: folder)
      try check([.modelEntity(geometry: Geometry())], in: folder)
    }
  }

  @Test func unwritableOutputsAreRejected() throws {
    try withTemporaryFolder { folder in
      try Data().write(to: folder.appendingPathComponent("file"))
      let wrong = [
        folder.appendingPathComponent("model.obj"),
        folder.appendingPathComponent("model.glb"),
        folder.appendingPathComponent("model.ply"),
        folder.appendingPathComponent("missing/model.usdz"),
        folder.appendingPathComponent("file/model.usdz"),
        folder.appendingPathComponent("file/x", isDirectory: true),
        URL(fileURLWithPath: "/proc/model.usdz"),
        try #require(URL(string: "https://example.com/model.usdz")),
      ]
      for url in wrong {
        do {
          try check([.modelFile(url: url)], in: folder)
          Issue.record("\(url) was accepted")
        } catch {
          #expect(isInvalidOutput(error) && sentence(of: error).count > 40, "\(url): \(error)")
        }
      }
    }
  }

  @Test func requestsAreChecked() throws {
    try withTemporaryFolder { folder in
      try Data().write(to: folder.appendingPathComponent("photo.jpg"))
      let url = folder.appendingPathComponent("model.usdz")
      try check([.modelFile(url: url), .poses], in: folder)
      #expect(throws: ProcessingError.self) { try check([], in: folder) }
      #expect(throws: ProcessingError.self) {
        try check([.modelFile(url: url), .modelFile(url: url, detail: .full)], in: folder)
      }
      #expect(throws: Session.Error.self) {
        try check([.modelFile(url: url)], in: folder, free: 9_999_999)
      }
      #expect(throws: Session.Error.self) {
        try check([.poses], in: folder.appendingPathComponent("gone"))
      }
      #expect(throws: ProcessingError.self) {
        try check([.poses], in: folder, checkpoint: folder.appendingPathComponent("photo.jpg"))
      }
      try check([.poses], in: folder, checkpoint: folder.appendingPathComponent("new/checkpoint"))
    }
  }
}

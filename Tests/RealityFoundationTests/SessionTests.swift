import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline
@testable import RealityFoundation

/// The behavior of a session with a scripted engine.
@Suite(.timeLimit(.minutes(10))) struct SessionTests {
  typealias Session = PhotogrammetrySession

  private func withPhotos(_ body: (URL) async throws -> Void) async throws {
    try await withTaskExecutorPreference(QueueExecutor()) {
      try await withTemporaryFolder { folder in
        try Data("photo".utf8).write(to: folder.appendingPathComponent("a.jpg"))
        try await body(folder)
      }
    }
  }

  @Test func ordersItsOutputs() async throws {
    try await withPhotos { folder in
      let script = ScriptedEngine.Script(
        rejected: [
          RejectedPhoto(sampleID: 1, name: "b", fault: .unreadable, reason: "It can't be decoded.")
        ], isDownsampled: true, registered: 11)
      let session = Session(folder: folder, script)
      let model = Session.Request.modelFile(url: folder.appendingPathComponent("m.usdz"))
      let outputs = try await run(session, [model, .poses])
      let names = outputs.map(name(of:))
      #expect(names.first == "invalidSample" && names.last == "processingComplete")
      let input = try #require(names.firstIndex(of: "inputComplete"))
      #expect(try #require(names.firstIndex(of: "automaticDownsampling")) < input)
      #expect(names.contains("stitchingIncomplete") && names.contains("requestProgressInfo"))
      let completed = outputs.filter { name(of: $0) == "requestComplete" }
      #expect(completed.compactMap(request(of:)) == [.poses, model])
      #expect(!session.isProcessing && session.activeRequests.isEmpty && session.report != nil)
      for expectedRequest in [model, .poses] {
        let fractions = outputs.compactMap { output -> Double? in
          if case .requestProgress(expectedRequest, let fraction) = output { fraction } else { nil }
        }
        #expect(fractions == fractions.sorted() && fractions.last == 1)
      }
    }
  }

  @Test func reusesTheEngine() async throws {
    try await withPhotos { folder in
      let journal = ScriptedEngine.Journal()
      let session = Session(folder: folder, journal: journal)
      _ = try await run(session, [.poses])
      let names = try await run(session, [.bounds, .pointCloud]).map(name(of:))
      #expect(journal.count(of: "made") == 1)
      #expect(!names.contains("inputComplete"))
      #expect(names.filter { $0 == "requestComplete" }.count == 2)
    }
  }

  @Test func aFailedRequestDoesNotStopOthers() async throws {
    try await withPhotos { folder in
      let session = Session(folder: folder, .init(entityError: .emptyCrop))
      let outputs = try await run(session, [.modelEntity(), .poses])
      let names = outputs.map(name(of:))
      #expect(names.contains("requestError") && names.contains("requestComplete"))
      #expect(names.last == "processingComplete")
      let error = try #require(errors(in: outputs).first as? ProcessingError)
      #expect(error.code == .emptyCrop && !error.remedy.isEmpty)
    }
  }

  @Test func outOfMemoryIsRetriedAtHalfTheResolution() async throws {
    try await withPhotos { folder in
      let journal = ScriptedEngine.Journal()
      let session = Session(folder: folder, .init(pixelsInMemory: 250_001), journal: journal)
      let names = try await run(session, [.modelEntity(detail: .medium)]).map(name(of:))
      #expect(names.filter { $0 == "automaticDownsampling" }.count == 1)
      #expect(names.contains("requestComplete") && !names.contains("requestError"))
      #expect(journal.count(of: "limited to 250000") == 1)
    }
  }

  @Test func outOfMemoryTwiceFailsOnlyThatRequest() async throws {
    try await withPhotos { folder in
      let session = Session(folder: folder, .init(pixelsInMemory: 1000))
      let outputs = try await run(session, [.modelEntity(detail: .medium), .poses])
      let names = outputs.map(name(of:))
      #expect(names.contains("requestComplete") && names.last == "processingComplete")
      let error = try #require(errors(in: outputs).first as? ProcessingError)
      #expect(error.code == .outOfMemory && error.remedy.contains("lower detail"))
    }
  }

  @Test func badInputFailsEveryRequest() async throws {
    try await withPhotos { folder in
      let session = Session(
        folder: folder, .init(ingestError: .tooFewPhotos(found: 2, needed: 3)))
      let outputs = try await run(session, [.bounds, .poses])
      let names = outputs.map(name(of:))
      #expect(names == ["requestError", "requestError", "processingComplete"])
      let error = try #require(errors(in: outputs).first)
      #expect((error as NSError).code == ProcessingError.Code.tooFewPhotos.rawValue)
      #expect(sentence(of: error).contains("2 usable photos"))
    }
  }

  @Test func failedAlignmentHasCodeSix() async throws {
    try await withPhotos { folder in
      let session = Session(
        folder: folder, .init(alignmentError: .alignmentFailed(reason: "no overlap.")))
      let outputs = try await run(session, [.poses])
      let error = try #require(errors(in: outputs).first)
      #expect((error as NSError).code == 6)
      #expect(error.localizedDescription.contains("no overlap."))
    }
  }

  @Test func canceledSessionsStopAndCanContinue() async throws {
    try await withPhotos { folder in
      let journal = ScriptedEngine.Journal()
      let session = Session(folder: folder, .init(repeatsUntilCanceled: true), journal: journal)
      session.cancel()
      try session.process(requests: [.poses])
      #expect(session.isProcessing && session.activeRequests == [.poses])
      #expect(throws: ProcessingError.alreadyProcessing) {
        try session.process(requests: [.bounds])
      }
      for try await output in session.outputs where name(of: output) == "requestProgress" { break }
      session.cancel()
      let names = try await outputsUntilEnd(session.outputs).map(name(of:))
      #expect(names.last == "processingCancelled" && !names.contains("requestComplete"))
      #expect(!session.isProcessing)
      // The session can continue with a new engine whose cancellation flag is not set.
      try session.process(requests: [.poses])
      for try await output in session.outputs where name(of: output) == "requestProgress" { break }
      session.cancel()
      let last = try await outputsUntilEnd(session.outputs).last
      #expect(last.map(name(of:)) == "processingCancelled")
      #expect(journal.count(of: "made") == 2)
    }
  }

  @Test func immediateCancelIsNotLost() async throws {
    try await withPhotos { folder in
      let session = Session(folder: folder, .init(repeatsUntilCanceled: true))
      for _ in 0..<20 {
        try session.process(requests: [.poses])
        session.cancel()
        let last = try await outputsUntilEnd(session.outputs).last
        #expect(last.map(name(of:)) == "processingCancelled")
      }
    }
  }

  @Test func outputsEndWithTheSession() async throws {
    try await withPhotos { folder in
      let journal = ScriptedEngine.Journal()
      var session: Session? = Session(folder: folder, journal: journal)
      weak let reference = session
      let outputs = try #require(session?.outputs)
      try session?.process(requests: [.poses])
      // The work is completed although nothing refers to the session anymore.
      session = nil
      var names: [String] = []
      for try await output in outputs { names.append(name(of: output)) }
      #expect(names.contains("requestComplete") && names.last == "processingComplete")
      #expect(reference == nil)
      while journal.count(of: "gone") < 1 { await Task.yield() }
    }
  }

  @Test func idleSessionIsDeallocated() async throws {
    try await withPhotos { folder in
      weak var reference: Session?
      do {
        let session = Session(folder: folder)
        reference = session
        _ = try await run(session, [.poses])
        _ = try await run(session, [.bounds])
      }
      for _ in 0..<1000 where reference != nil { try await Task.sleep(for: .milliseconds(1)) }
      #expect(reference == nil)
    }
  }
}

@Suite struct SessionInputTests {
  private func expectInvalid(_ url: URL, containing text: String) {
    do {
      _ = try PhotogrammetrySession(input: url)
      Issue.record("\(url.path) was accepted")
    } catch {
      #expect(sentence(of: error).contains(text), "\(error)")
      #expect((error as NSError).code == 0)
    }
  }

  @Test func unusableFoldersAreRejected() throws {
    try withTemporaryFolder { folder in
      expectInvalid(folder, containing: "is empty")
      expectInvalid(folder.appendingPathComponent("missing"), containing: "does not exist")
      let file = folder.appendingPathComponent("file.jpg")
      try Data().write(to: file)
      expectInvalid(file, containing: "is a file")
      expectInvalid(
        try #require(URL(string: "https://example.com/photos")), containing: "not on a disk")
      #expect(try !PhotogrammetrySession(input: folder).isProcessing)
    }
  }
}

import Foundation
import SceneModel
import Testing

@testable import Pipeline
@testable import RealityFoundation

@Suite struct SessionStateTests {
  typealias Session = PhotogrammetrySession

  static let model = Session.Request.modelFile(
    url: URL(fileURLWithPath: "/tmp/model.usdz"), detail: .preview)

  /// A state that has begun to process the requests, with their plan.
  private func begun(
    _ requests: [Session.Request] = [.poses, model]
  ) throws -> (SessionState, RunPlan) {
    var state = SessionState()
    let plan = RunPlan(requests, configuration: .init())
    try state.begin(plan, photoCount: 10, threadCount: 2, at: 0)
    return (state, plan)
  }

  private func names(_ outputs: [Session.Output]) -> [String] { outputs.map(name(of:)) }

  @Test func passesThroughARun() throws {
    var (state, plan) = try begun()
    #expect(state.isProcessing && state.phase == .ingesting)
    #expect(state.activeRequests == [.poses, Self.model])
    #expect(names(state.ingested(.init(count: 9))) == ["inputComplete"])
    #expect(state.phase == .processing)
    let poses = Session.Result.poses(.init(posesBySample: [:], urlsBySample: [:]))
    #expect(
      names(state.completed(plan.entries[0], poses, at: 1))
        == ["requestProgress", "requestComplete"])
    #expect(state.activeRequests == [Self.model])
    #expect(
      names(state.failed(plan.entries[1], ProcessingError.alreadyProcessing)) == ["requestError"])
    #expect(state.isProcessing && state.activeRequests.isEmpty)
    #expect(names(state.finished()) == ["processingComplete"])
    #expect(!state.isProcessing)
    #expect(state.finished().isEmpty)
  }

  @Test func rejectsASecondBegin() throws {
    var (state, plan) = try begun()
    #expect(throws: ProcessingError.alreadyProcessing) {
      try state.begin(plan, photoCount: 10, threadCount: 2, at: 1)
    }
    let isStopping = state.cancel()
    #expect(isStopping)
    #expect(throws: ProcessingError.alreadyProcessing) {
      try state.begin(plan, photoCount: 10, threadCount: 2, at: 1)
    }
  }

  @Test func reportsTheInputOnce() throws {
    var (state, plan) = try begun()
    let photo = RejectedPhoto(sampleID: 3, name: "a.jpg", fault: .blurred, reason: "It is blurred.")
    #expect(names(state.rejected(photo)) == ["invalidSample"])
    #expect(state.rejected(photo).isEmpty)
    _ = state.ingested(.init(count: 9))
    _ = state.finished()
    try state.begin(plan, photoCount: 10, threadCount: 2, at: 5)
    #expect(state.phase == .processing)
    let repeated = state.rejected(photo) + state.ingested(.init(count: 9))
    #expect(repeated.isEmpty)
  }

  @Test(arguments: [
    RejectedPhoto.Fault.unreadable, .tooLarge, .tooMany, .duplicate, .notRegistered,
  ])
  func faultsBecomeOutputs(fault: RejectedPhoto.Fault) throws {
    var (state, _) = try begun()
    let outputs = state.rejected(
      RejectedPhoto(sampleID: 3, name: "a.jpg", fault: fault, reason: "Because."))
    #expect(names(outputs) == [fault == .notRegistered ? "skippedSample" : "invalidSample"])
  }

  @Test func cancelingSuppressesAllButTheLastOutput() throws {
    var (state, plan) = try begun()
    _ = state.ingested(.init(count: 9))
    let isStopping = state.cancel()
    #expect(isStopping)
    let again = state.cancel()
    #expect(!again)
    #expect(state.isProcessing)
    #expect(state.progressed(.imageAlignment, fraction: 0.5, at: 3).isEmpty)
    #expect(state.completed(plan.entries[0], .bounds(.empty), at: 4).isEmpty)
    #expect(state.failed(plan.entries[1], ProcessingError.alreadyProcessing).isEmpty)
    let suppressed = state.downsampled() + state.stitchingIncomplete()
    #expect(suppressed.isEmpty)
    #expect(names(state.finished()) == ["processingCancelled"])
    #expect(!state.isProcessing && state.activeRequests.isEmpty)
  }

  @Test func cancelingWhenIdleHasNoEffect() {
    var state = SessionState()
    let isStopping = state.cancel()
    #expect(!isStopping)
    let outputs = state.finished()
    #expect(outputs.isEmpty && state.phase == .idle)
  }

  @Test func progressIsMonotoneForAllActiveRequests() throws {
    var (state, plan) = try begun()
    _ = state.ingested(.init(count: 9))
    state.began(plan.entries[0])
    var fractions: [Session.Request: [Double]] = [:]
    var time = 0.0
    for value in [0.1, 0.3, 0.2, 0.9, 1.0] {
      time += 1
      for case .requestProgress(let request, let fraction) in state.progressed(
        .imageAlignment, fraction: value, at: time)
      {
        fractions[request, default: []].append(fraction)
      }
    }
    for request in [Session.Request.poses, Self.model] {
      let reported = try #require(fractions[request])
      #expect(
        reported == reported.sorted() && reported.count >= 3 && reported.allSatisfy { 0...1 ~= $0 })
    }
    // Most of the model's work remains when the poses are almost complete.
    #expect(try #require(fractions[.poses]?.last) > 0.9)
    #expect(try #require(fractions[Self.model]?.last) < 0.6)
    // A later stage does not affect the poses.
    state.began(plan.entries[1])
    let later = state.progressed(.meshGeneration, fraction: 0.5, at: 20)
    #expect(later.allSatisfy { request(of: $0) == Self.model } && !later.isEmpty)
  }

  @Test func smallStepsAreNotReported() throws {
    var (state, plan) = try begun()
    _ = state.ingested(.init(count: 9))
    state.began(plan.entries[0])
    let outputs = (0..<100_000).flatMap {
      state.progressed(.imageAlignment, fraction: Double($0) / 100_000, at: Double($0) / 1000)
    }
    #expect(outputs.count < 2 * 2 * 1001 && outputs.count > 100)
  }

  @Test func stagesAndRemainingTimeAreReported() throws {
    var (state, plan) = try begun()
    _ = state.ingested(.init(count: 9))
    state.began(plan.entries[0])
    let outputs = state.progressed(.imageAlignment, fraction: 0.5, at: 10)
    let infos = outputs.compactMap { output -> Session.Output.ProgressInfo? in
      if case .requestProgressInfo(.poses, let info) = output { info } else { nil }
    }
    let info = try #require(infos.first)
    #expect(info.processingStage == .imageAlignment)
    #expect(abs(try #require(info.estimatedRemainingTime) - 10) < 3)
  }

  @Test func downsamplingAndStitchingAreReportedOnce() throws {
    var (state, _) = try begun()
    #expect(names(state.downsampled()) == ["automaticDownsampling"])
    #expect(state.downsampled().isEmpty)
    #expect(names(state.stitchingIncomplete()) == ["stitchingIncomplete"])
    #expect(state.stitchingIncomplete().isEmpty)
  }
}

import SceneModel
import Testing

@testable import Pipeline

@Suite struct RunProgressTrackerTests {
  private let medium = DetailSpecification(.medium)

  private func durations(
    count: Int = 20, alignment: StageDurationModel.AlignmentWork = .search,
    denseShare: Double = 1
  ) -> StageDurationModel {
    StageDurationModel(
      photos: PhotoTotals(count: count), finest: medium, threadCount: 2, alignment: alignment,
      denseShare: denseShare)
  }

  /// At the expected pace, the fraction and the remaining time are those of the model.
  @Test func progressFollowsTheModel() throws {
    let stages: [PipelineStage] = [.preProcessing, .imageAlignment, .pointCloudGeneration]
    let model = durations()
    let total = model.seconds(of: stages)
    var tracker = RunProgressTracker(stages: stages, durations: model, at: 100)
    var time = 100.0
    var last: RunProgressTracker.Progress?
    for stage in stages {
      for step in 1...10 {
        time += model.seconds(of: WorkUnit(stage: stage)) / 10
        last = tracker.update(.progress(stage, fraction: Double(step) / 10), at: time)
        let progress = try #require(last)
        #expect(progress.stage == stage)
        #expect(abs(progress.fraction - (time - 100) / total) < 1e-9)
        if let remaining = progress.remainingSeconds {
          #expect(abs(remaining - (total - (time - 100))) < 0.01 * total)
        }
      }
    }
    #expect(last?.fraction == 1)
  }

  /// Each model has a share of the progress, and the time of all is counted.
  @Test func severalModelsAreOneRun() throws {
    let coarser = [DetailSpecification(.preview), DetailSpecification(.reduced)]
    let stages: [PipelineStage] = [.preProcessing, .textureMapping, .optimization]
    let model = durations()
    var units = [WorkUnit(stage: .preProcessing)]
    for specification in coarser + [medium] {
      units += stages.dropFirst().map { WorkUnit(stage: $0, specification: specification) }
    }
    let total = units.reduce(0) { $0 + model.seconds(of: $1) }
    var tracker = RunProgressTracker(
      stages: stages, coarserModels: coarser, durations: model, at: 0)
    var time = 0.0
    for unit in units {
      // The end of a stage may be reported twice.
      for fraction in [0.5, 1, 1] {
        if fraction == 0.5 { time += model.seconds(of: unit) }
        let last = tracker.update(.progress(unit.stage, fraction: fraction), at: time)
        let progress = try #require(last)
        if fraction == 1 { #expect(abs(progress.fraction - time / total) < 1e-9) }
      }
    }
    #expect(abs(time - total) < 1e-9)
  }

  @Test func otherStagesAndEventsChangeNothing() {
    var tracker = RunProgressTracker(
      stages: [.preProcessing], durations: durations(), at: 0)
    let events: [PipelineEvent] = [
      .progress(.meshGeneration, fraction: 0.5), .warning("A sentence."), .downsampled,
    ]
    for event in events {
      let progress = tracker.update(event, at: 1)
      #expect(progress == nil)
    }
  }

  /// Until validation ends, the number of photos is an estimate.
  @Test func ingestedPhotosReweighStages() throws {
    func fraction(photos: Int) throws -> Double {
      var tracker = RunProgressTracker(
        stages: [.preProcessing, .pointCloudGeneration, .meshGeneration], durations: durations(),
        at: 0)
      _ = tracker.update(.ingested(PhotoTotals(count: photos)), at: 1)
      let progress = tracker.update(.progress(.preProcessing, fraction: 1), at: 2)
      return try #require(progress).fraction
    }
    // More photos make the mesh a smaller part of the run.
    #expect(try fraction(photos: 200) > fraction(photos: 10))
  }

  @Test func givenCamerasTakeLessTime() {
    let alignment = [
      StageDurationModel.AlignmentWork.none, .triangulation, .search,
    ].map { durations(alignment: $0).seconds(of: .alignment) }
    #expect(alignment[0] < 0.1 && alignment[0] < alignment[1] && alignment[1] < alignment[2])
  }

  @Test func aJobTakesItsShareOfTheDenseStage() {
    let (whole, part) = (durations(), durations(denseShare: 0.25))
    let ratio = part.seconds(of: .densification) / whole.seconds(of: .densification)
    #expect(abs(ratio - 0.25) < 0.05)
    #expect(part.seconds(of: .alignment) == whole.seconds(of: .alignment))
  }

  @Test func theTotalIsThatOfAllStages() {
    let model = durations()
    let sum = PipelineStage.allCases.reduce(0) { $0 + model.seconds(of: WorkUnit(stage: $1)) }
    #expect(abs(model.total - sum) < 1e-9)
  }
}

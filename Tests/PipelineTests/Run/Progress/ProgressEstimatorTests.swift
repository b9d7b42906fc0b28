import Testing

@testable import Pipeline

@Suite struct ProgressEstimatorTests {
  static let units = PipelineStage.allCases.map { WorkUnit(stage: $0) }
  static let usual: [PipelineStage: Double] = [
    .preProcessing: 5, .imageAlignment: 60, .pointCloudGeneration: 120, .meshGeneration: 20,
    .textureMapping: 30, .optimization: 5,
  ]

  /// Simulates all stages with their true durations; returns the estimated remaining time after
  /// each step.
  private func simulate(
    _ truth: (PipelineStage) -> Double
  ) -> [(time: Double, total: Double, estimate: Double?)] {
    var estimator = ProgressEstimator(units: Self.units, at: 100) { Self.usual[$0.stage] ?? 0 }
    let total = PipelineStage.allCases.reduce(0) { $0 + truth($1) }
    var samples: [(Double, Double, Double?)] = []
    var time = 0.0
    for stage in PipelineStage.allCases {
      for step in 1...20 {
        time += truth(stage) / 20
        estimator.advance(WorkUnit(stage: stage), to: Double(step) / 20, at: 100 + time)
        samples.append((time, total, estimator.remainingSeconds(of: Self.units)))
      }
    }
    return samples
  }

  @Test(arguments: [0.1, 0.5, 1, 3, 12])
  func machineSpeedIsEstimated(factor: Double) throws {
    for sample in simulate({ (Self.usual[$0] ?? 0) * factor }) where sample.time > sample.total / 3
    {
      let estimate = try #require(sample.estimate)
      #expect(abs(estimate - (sample.total - sample.time)) < 0.05 * sample.total)
    }
  }

  /// After 30 of 60 seconds it turns out that alignment takes 120.
  @Test func workThatTurnsUpIsExpected() throws {
    let unit = WorkUnit(stage: .imageAlignment)
    var estimator = ProgressEstimator(units: [unit], at: 0) { _ in 60 }
    estimator.advance(unit, to: 0.5, at: 30)
    estimator.extend(unit, by: 2)
    #expect(abs(estimator.fraction(of: [unit]) - 0.25) < 1e-9)
    #expect(abs(try #require(estimator.remainingSeconds(of: [unit])) - 90) < 1)
    estimator.advance(unit, to: 1, at: 120)
    estimator.extend(unit, by: 2)
    #expect(estimator.fraction(of: [unit]) == 1)
  }

  @Test func unevenStagesAreEstimatedWithinHalfAfterTheFirstThird() throws {
    let factors: [PipelineStage: Double] = [
      .preProcessing: 2, .imageAlignment: 1.6, .pointCloudGeneration: 0.8, .meshGeneration: 1.5,
      .textureMapping: 0.7, .optimization: 2,
    ]
    let samples = simulate { (Self.usual[$0] ?? 0) * (factors[$0] ?? 1) }
    for sample in samples where sample.time > sample.total / 3 {
      let estimate = try #require(sample.estimate)
      #expect(abs(estimate - (sample.total - sample.time)) < 0.5 * sample.total)
    }
    #expect(try #require(samples.last?.estimate) < 1e-9)
  }

  @Test func thereIsNoEstimateBeforeEvidence() {
    var estimator = ProgressEstimator(units: Self.units, at: 0) { Self.usual[$0.stage] ?? 0 }
    #expect(estimator.remainingSeconds(of: Self.units) == nil)
    estimator.advance(WorkUnit(stage: .preProcessing), to: 0.1, at: 0.4)
    #expect(estimator.remainingSeconds(of: Self.units) == nil)
  }

  @Test func reusedWorkDoesNotAffectTheSpeed() throws {
    var estimator = ProgressEstimator(units: Self.units, at: 0) { Self.usual[$0.stage] ?? 0 }
    estimator.advance(WorkUnit(stage: .preProcessing), to: 1, at: 5)
    estimator.advance(WorkUnit(stage: .imageAlignment), to: 1, at: 5.01)
    estimator.advance(WorkUnit(stage: .pointCloudGeneration), to: 0.5, at: 65.01)
    let estimate = try #require(estimator.remainingSeconds(of: Self.units))
    #expect(abs(estimate - 115) < 5)
  }

  @Test func fractionsAreWeightedAndMonotone() {
    var estimator = ProgressEstimator(units: Self.units, at: 0) { Self.usual[$0.stage] ?? 0 }
    let alignment = [WorkUnit(stage: .preProcessing), WorkUnit(stage: .imageAlignment)]
    estimator.advance(alignment[0], to: 1, at: 5)
    #expect(abs(estimator.fraction(of: alignment) - 5 / 65.0) < 1e-12)
    estimator.advance(alignment[1], to: 0.5, at: 30)
    estimator.advance(alignment[1], to: 0.2, at: 31)
    estimator.advance(alignment[1], to: .nan, at: 32)
    #expect(abs(estimator.fraction(of: alignment) - 35 / 65.0) < 1e-12)
    #expect(abs(estimator.fraction(of: Self.units) - 35 / 240.0) < 1e-12)
    estimator.advance(alignment[1], to: 7, at: 60)
    #expect(estimator.fraction(of: alignment) == 1)
  }

  @Test func precedingWorkIsIncluded() throws {
    var estimator = ProgressEstimator(units: Self.units, at: 0) { Self.usual[$0.stage] ?? 0 }
    estimator.advance(WorkUnit(stage: .preProcessing), to: 1, at: 5)
    let all = try #require(estimator.remainingSeconds(of: Self.units))
    let last = try #require(estimator.remainingSeconds(of: [WorkUnit(stage: .optimization)]))
    #expect(all == last)
    let alignment = try #require(
      estimator.remainingSeconds(of: [WorkUnit(stage: .imageAlignment)]))
    #expect(abs(alignment - 60) < 1e-9)
  }
}

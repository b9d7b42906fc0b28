import SceneModel
import Testing

@testable import Pipeline

@Suite struct ReportAssessmentTests {
  private func report(
    used: Int, of count: Int, photosHistogram: [Double]? = [0.1, 0, 0.05, 0.85]
  ) -> RunReport {
    var report = RunReport(configuration: PipelineConfiguration())
    report.photos = (0..<count).map {
      .init(name: "p\($0).jpg", status: $0 < used ? .registered : .notRegistered)
    }
    if let photosHistogram {
      report.surface = SurfaceStatistics(
        triangles: 100, vertices: 52, photosHistogram: photosHistogram, closedShare: 0.1)
    }
    return report
  }

  @Test(arguments: [
    (20, 20, RunVerdict.Level.good), (19, 20, .good), (18, 20, .fair), (13, 20, .fair),
    (12, 20, .poor), (1, 20, .poor),
  ])
  func photosDecide(used: Int, count: Int, level: RunVerdict.Level) {
    #expect(report(used: used, of: count).assessed.verdict?.level == level)
  }

  @Test func aSurfaceThatFewPhotosShowIsNotGood() {
    let report = report(used: 20, of: 20, photosHistogram: [0.2, 0.1, 0.1, 0.6])
    #expect(
      report.assessed.verdict
        == RunVerdict(
          level: .fair,
          sentence: "All 20 photos were used; three or more photos show 60 % of the surface."))
  }

  @Test func copiesAndOtherFilesDoNotCount() {
    var report = report(used: 20, of: 20)
    for fault in [RejectedPhoto.Fault.duplicate, .unsupportedFormat] {
      var entry = RunReport.PhotoEntry(name: "\(fault)", status: .rejected)
      entry.fault = fault
      report.photos.append(entry)
    }
    #expect(report.assessed.verdict?.level == .good)
    report.photos[20].fault = .blurred
    report.photos[21].fault = .unreadable
    #expect(report.assessed.verdict?.level == .fair)
  }

  @Test(arguments: [(0.9, RunVerdict.Level.good), (0.8, .fair), (0.3, .poor)])
  func aModelOfAPartOfTheObjectIsNotGood(outline: Double, level: RunVerdict.Level) {
    var report = report(used: 20, of: 20)
    report.surface?.outlineShare = outline
    report.advice = [Advice(kind: .surface, sentence: "Lay it down.")]
    let assessed = report.assessed
    #expect(assessed.verdict?.level == level)
    #expect(assessed.advice.map(\.kind) == (level == .good ? [.surface] : [.texture]))
  }

  @Test func errorsAndConcernsDecide() {
    var failed = report(used: 0, of: 3, photosHistogram: nil)
    failed.errors = ["The photos show nothing."]
    #expect(failed.assessed.verdict?.level == .failed)
    #expect(failed.assessed.verdict?.sentence == "There is no model. The photos show nothing.")
    #expect(failed.assessed.photos.allSatisfy { $0.reason?.contains("the run ended") == true })
    var suspect = report(used: 20, of: 20)
    suspect.concerns = ["It may be the table."]
    #expect(suspect.assessed.verdict?.level == .poor)
  }

  @Test func beforeARunNothingIsJudged() {
    let verdict = report(used: 0, of: 4, photosHistogram: nil).assessed.verdict
    #expect(verdict == RunVerdict(level: .unknown, sentence: "All 4 photos can be used."))
  }
}

import Foundation
import Pipeline
import SceneModel
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite struct OverlapReportTests {
  private func report(
    pairs: [(Int, Int, matches: Int)], rejected: [(Int, Int, matches: Int)] = []
  ) -> OverlapReport {
    let graph = ViewGraph(
      photoCount: 12,
      pairs: pairs.map { a, b, matches in
        VerifiedPair(
          pair: PhotoPair(ID(a), ID(b)), model: .essential, secondFromFirst: nil,
          matches: (0..<matches).map { FeatureMatch(first: Int32($0), second: Int32($0)) },
          medianAngle: 0)
      },
      rejected: rejected.map {
        RejectedPair(pair: PhotoPair(ID($0), ID($1)), matches: $2, needed: 20)
      })
    return OverlapReport(
      OverlapSurvey.Result(graph, featureCounts: Array(repeating: 100, count: 12)),
      SyntheticScene().photos)
  }

  @Test func groupsAndIsolatedPhotosAreListed() throws {
    let report = report(
      pairs: (0..<6).map { ($0, $0 + 1, 30 + $0) } + (8..<11).map { ($0, $0 + 1, 50) },
      rejected: [(2, 7, 9), (6, 7, 12)])
    #expect(report.groups.map(\.count) == [7, 4, 1])
    #expect(report.photos[3].partners.map(\.name) == ["photo004.jpg", "photo002.jpg"])
    #expect(report.photos[3].partners.map(\.matches) == [33, 32])
    #expect(report.photos[3].nearest == nil)
    let lines = report.lines
    #expect(lines.contains("photo007.jpg  none; nearest is photo006.jpg (12)"))
    #expect(lines.contains("photo003.jpg  2: photo004.jpg (33), photo002.jpg (32)"))
    #expect(
      lines.contains {
        $0.contains("7 (photo000.jpg to photo006.jpg), 4 (photo008.jpg to photo011.jpg)")
      })
    #expect(lines.contains { $0.hasPrefix("photo007.jpg overlaps with no other photo") })
  }

  @Test func onlyTheStrongestPartnersAreListed() {
    let report = report(pairs: (1..<12).map { (0, $0, 20 + $0) })
    #expect(report.photos[0].partners.count == 11)
    #expect(report.lines.contains { $0.hasPrefix("photo000.jpg  11: photo011.jpg (31)") })
    #expect(report.lines.contains { $0.hasSuffix("photo008.jpg (28) and 7 more") })
    #expect(report.lines.last == "All photos are connected.")
  }
}

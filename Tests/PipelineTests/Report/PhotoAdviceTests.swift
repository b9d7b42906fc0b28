import SceneModel
import Testing

@testable import Pipeline

@Suite struct PhotoAdviceTests {
  /// Photos 0…4 match in a chain, as do 5…7; 8 matches none. `rejected` pairs don't suffice.
  private func report(
    rejected: [(Int, Int, matches: Int)], registered: Range<Int> = 0..<5
  ) -> RunReport {
    var report = RunReport(configuration: PipelineConfiguration())
    let names = (0..<9).map { "p\($0).jpg" }
    report.photos = names.indices.map {
      .init(name: names[$0], status: registered.contains($0) ? .registered : .notRegistered)
    }
    var pairs = MatchRecord()
    pairs.features = [Int](repeating: 1000, count: 9)
    let used = [(0, 1), (1, 2), (2, 3), (3, 4), (5, 6), (6, 7)].map { ($0.0, $0.1, 100, 0) }
    for (a, b, matches, needed) in used + rejected.map({ ($0.0, $0.1, $0.matches, 15) }) {
      pairs.first.append(a)
      pairs.second.append(b)
      pairs.matches.append(matches)
      pairs.needed.append(needed)
      pairs.degrees.append(0)
    }
    report.matches = .init(photos: names, pairs: pairs)
    return report
  }

  private func advice(_ kind: Advice.Kind, on report: RunReport) -> [Advice] {
    report.assessed.advice.filter { $0.kind == kind }
  }

  @Test func aGapIsBridgedWhereItIsNarrowest() {
    let found = advice(
      .bridge, on: report(rejected: [(2, 5, matches: 4), (4, 7, matches: 11), (4, 8, matches: 14)]))
    #expect(found.map(\.photos) == [["p7.jpg", "p4.jpg"], ["p8.jpg", "p4.jpg"]])
    #expect(found[0].sentence.contains("3 photos (p5.jpg, p6.jpg, p7.jpg)"))
  }

  @Test func withoutMatchesTheOrderOfFilesDecides() {
    let found = advice(.bridge, on: report(rejected: []))
    #expect(found.map(\.photos) == [["p4.jpg", "p5.jpg"]])
  }

  /// A few matches may occur by chance.
  @Test func chanceIsNoLink() {
    let found = advice(.bridge, on: report(rejected: [(0, 7, matches: 5)]))
    #expect(found.map(\.photos) == [["p4.jpg", "p5.jpg"]])
  }

  /// Photos 3 and 4 match photo 2, but were not aligned.
  @Test func whatWasNotAlignedIsBridged() {
    let found = advice(.bridge, on: report(rejected: [], registered: 0..<3))
    #expect(found.map(\.photos) == [["p2.jpg", "p5.jpg"], ["p3.jpg", "p2.jpg"]])
  }

  @Test func blurIsReasonEnough() {
    var report = report(rejected: [])
    report.photos[8].sharpness = 0.2
    #expect(advice(.photos, on: report).isEmpty)
  }

  @Test func withoutAlignmentTheLargestGroupIsTheRest() {
    let found = advice(.bridge, on: report(rejected: [], registered: 0..<0))
    #expect(found.map(\.photos) == [["p4.jpg", "p5.jpg"]])
  }

  @Test func photosWithoutPartnersAreNamed() {
    #expect(advice(.photos, on: report(rejected: [])).map(\.photos) == [["p8.jpg"]])
  }

  @Test func aConnectedSetNeedsNoBridge() {
    var report = report(rejected: [])
    report.matches = nil
    #expect(report.assessed.advice.isEmpty)
  }

  @Test func blurIsSpokenOfIfItIsCommon() {
    var report = report(rejected: [])
    report.photos[3].sharpness = 0.2
    #expect(advice(.blur, on: report).first?.photos == ["p3.jpg"])
    report.photos += (0..<20).map { .init(name: "q\($0).jpg", status: .registered) }
    #expect(advice(.blur, on: report).isEmpty)
  }

  @Test func exposureIsSpokenOfIfItDiffersMuch() {
    var report = report(rejected: [])
    for index in report.photos.indices { report.photos[index].exposure = 0.1 * Double(index) }
    #expect(advice(.exposure, on: report).isEmpty)
    report.photos[0].exposure = -1.6
    let found = advice(.exposure, on: report)
    #expect(found.map(\.photos) == [["p0.jpg"]])
    #expect(found[0].sentence.hasPrefix("p0.jpg is up to 4.0 times brighter or darker"))
  }

  @Test func anEmptyOutlineIsSpokenOf() {
    var report = report(rejected: [])
    report.matches = nil
    report.surface = SurfaceStatistics(
      triangles: 9, vertices: 9, photosHistogram: [1], closedShare: 1, outlineShare: 0.42)
    #expect(advice(.texture, on: report).first?.sentence.contains("42 %") == true)
  }
}

import Foundation
import Testing

@testable import Evaluation

@Suite struct RunFiguresTests {
  @Test func stagesAreSummed() throws {
    let report = """
      {"stages": [{"seconds": 2, "cpuSeconds": 3, "peakMemoryBytes": 7},
      {"seconds": 4, "cpuSeconds": 5, "peakMemoryBytes": 6}], "photos": [{}, {}, {}]}
      """
    let figures = try #require(RunFigures(report: Data(report.utf8)))
    #expect(figures.seconds == 6)
    #expect(figures.cpuSeconds == 8)
    #expect(figures.secondsPerPhoto == 2)
    #expect(figures.peakMemoryBytes == 7)
  }

  @Test func otherFilesHaveNoFigures() {
    #expect(RunFigures(report: Data("{\"stages\": [], \"photos\": []}".utf8)) == nil)
    #expect(RunFigures(report: Data("[]".utf8)) == nil)
  }
}

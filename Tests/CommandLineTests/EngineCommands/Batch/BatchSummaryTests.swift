import Foundation
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite struct BatchSummaryTests {
  private let summary = BatchSummary(datasets: [
    BatchEntry(
      name: "chair", status: .done, photos: 20, registered: 19, triangles: 49_998, seconds: 61.26,
      attempts: 2, model: "chair.usdz", fingerprint: "1"),
    BatchEntry(
      name: "a, \"b\"", status: .failed, photos: 0, seconds: 0.4, attempts: 1,
      error: "It is empty. Name another.", model: "a.usdz", fingerprint: "2"),
  ])

  @Test func tableNamesFailuresAndCounts() {
    #expect(
      summary.lines == [
        "name    status  photos  registered  triangles  time  attempts",
        "chair   done        20          19      49998  1:02         2",
        "a, \"b\"  failed       0                         0:01         1",
        "a, \"b\": It is empty. Name another.",
        "2 datasets: 1 done, 1 failed.",
      ])
  }

  @Test func fieldsOfCSVAreQuoted() {
    #expect(
      summary.csv
        == [
          "name,status,photos,registered,triangles,seconds,attempts,error,model\r\n",
          "chair,done,20,19,49998,61.3,2,,chair.usdz\r\n",
          "\"a, \"\"b\"\"\",failed,0,,,0.4,1,It is empty. Name another.,a.usdz\r\n",
        ].joined())
  }

  @Test func summaryRoundTripsThroughJSON() throws {
    let read = try JSONDecoder().decode(BatchSummary.self, from: summary.json())
    #expect(read == summary)
  }
}

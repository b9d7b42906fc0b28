import Foundation
import SharedCommands
import TestFiles
import Testing

@testable import EngineCommands

@Suite struct BatchBaselineTests {
  private static func entry(
    _ name: String, _ change: (inout BatchEntry) -> Void = { _ in }
  ) -> BatchEntry {
    var entry = BatchEntry(
      name: name, status: .done, photos: 20, registered: 20, triangles: 1000,
      model: "\(name).usdz", fingerprint: "0")
    var quality = RunQuality()
    (quality.verdict, quality.reprojection) = ("good", 0.2)
    (quality.missingShare, quality.outlineShare) = (0.01, 0.99)
    entry.quality = quality
    change(&entry)
    return entry
  }

  private func regressions(
    _ before: BatchEntry, _ after: BatchEntry?
  ) -> [BatchBaseline.Regression] {
    BatchBaseline(BatchSummary(datasets: [before]))
      .regressions(in: BatchSummary(datasets: [Self.entry("other")] + [after].compactMap { $0 }))
  }

  @Test func equalAndBetterResultsAreNotReported() {
    let entry = Self.entry("a")
    #expect(regressions(entry, entry) == [])
    let better = Self.entry("a") {
      $0.status = .skipped
      ($0.registered, $0.triangles) = (21, 2000)
      $0.quality?.reprojection = 0.1
      $0.quality?.missingShare = 0
    }
    #expect(regressions(entry, better) == [])
    // Time depends on the machine.
    #expect(regressions(entry, Self.entry("a") { $0.seconds = 1000 }) == [])
  }

  @Test func eachKindOfLossIsNamed() {
    let losses: [(String, (inout BatchEntry) -> Void)] = [
      ("19 photos have a pose, 20 before", { $0.registered = 19 }),
      ("700 triangles, 1000 before", { $0.triangles = 700 }),
      ("the verdict is poor, good before", { $0.quality?.verdict = "poor" }),
      ("error is 0.230 pixels, 0.200 before", { $0.quality?.reprojection = 0.23 }),
      ("4.0 % of the surface is missing", { $0.quality?.missingShare = 0.04 }),
      ("fills 97.0 % of the outline", { $0.quality?.outlineShare = 0.97 }),
      (
        "no model any more (out of memory)",
        {
          $0.status = .failed
          $0.error = "out of memory"
        }
      ),
    ]
    for (sentence, loss) in losses {
      let found = regressions(Self.entry("a"), Self.entry("a", loss))
      #expect(found.count == 1)
      #expect(found.first?.sentence.contains(sentence) == true, "\(sentence): \(found)")
    }
    #expect(regressions(Self.entry("a"), nil).first?.reasons == ["it is not in this batch"])
  }

  @Test func datasetsWithoutAModelBeforeCantGetWorse() {
    #expect(regressions(Self.entry("a") { $0.status = .failed }, nil) == [])
  }

  /// Summaries of versions that recorded no quality.
  @Test func olderSummariesAreCompared() throws {
    let before = Self.entry("a") { $0.quality = nil }
    let summary = try BatchSummary(datasets: [before]).json()
    let folder = try TemporaryFolder()
    let file = try folder.write([UInt8](summary), as: "batch.json")
    let baseline = try BatchBaseline(file.path)
    let worse = BatchSummary(datasets: [Self.entry("a") { $0.registered = 3 }])
    #expect(baseline.regressions(in: worse).map(\.name) == ["a"])
    #expect(baseline.regressions(in: BatchSummary(datasets: [Self.entry("a")])) == [])
  }

  @Test func otherFilesAreRefused() throws {
    let folder = try TemporaryFolder()
    let text = try folder.write("{}", as: "other.json")
    for path in [text.path, "/does/not/exist.json"] {
      #expect {
        try BatchBaseline(path)
      } throws: {
        ($0 as? CommandFailure)?.exitCode == CommandFailure.usageCode
      }
    }
  }
}

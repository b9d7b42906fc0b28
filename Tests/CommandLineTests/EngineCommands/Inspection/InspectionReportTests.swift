import Foundation
import Pipeline
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct InspectionReportTests {
  private func report(_ fixture: String) throws -> InspectionReport {
    InspectionReport(
      try PhotoIngestion().run(folder: Fixtures.images(of: fixture), StageContext()))
  }

  @Test func everyPhotoHasALine() throws {
    let report = try report("orbit")
    #expect(report.used.count == 20 && report.refused.isEmpty)
    try report.checkCount()
    #expect(report.lines.count == 21)
    let photo = try #require(report.used.first)
    #expect(report.lines[0].hasPrefix("\(photo.name)  \(photo.width) x \(photo.height)  camera 1"))
    #expect(report.lines[20].hasPrefix("20 photos of 1 camera would be used, 0 files not."))
  }

  @Test func tooFewPhotosAreAFault() throws {
    var report = try report("orbit")
    report.used.removeLast(18)
    let error = #expect(throws: PipelineError.self) { try report.checkCount() }
    #expect(error == .tooFewPhotos(found: 2, needed: 3))
    report.used.append(report.used[0])
    try report.checkCount()
  }

  @Test func summaryCountsMasksAndDownsampling() throws {
    var report = try report("orbit")
    report.used[3].maskCoverage = 0.004
    report.isDownsampled = true
    #expect(report.lines[3].hasSuffix("  mask 1 %"))
    #expect(report.lines.contains("1 of 20 photos have a mask."))
    #expect(report.lines.last?.contains("lower resolution") == true)
  }

  /// Programs read these names: a change breaks them.
  @Test func keysAreStable() throws {
    let object = try JSONSerialization.jsonObject(with: Data(report("orbit").encoded().utf8))
    let keys = try #require(object as? [String: Any])
    #expect(
      keys.keys.sorted() == ["cameras", "isDownsampled", "refused", "refusedMasks", "used"])
    let used = try #require((keys["used"] as? [[String: Any]])?.first)
    #expect(
      used.keys.sorted() == [
        "calibration", "camera", "focalLength", "hasPosition", "height", "name", "width",
      ])
  }
}

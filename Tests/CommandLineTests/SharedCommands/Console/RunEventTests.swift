import Foundation
import Testing

@testable import SharedCommands

@Suite struct RunEventTests {
  @Test func eventsAreOneLineOfJSON() {
    let progress = RunProgress(fraction: 0.5, stage: .meshGeneration, remaining: nil)
    #expect(
      RunEvent.progress(progress).line
        == #"{"event":"progress","fraction":0.5,"stage":"meshGeneration"}"#)
    let written = RunEvent("written") { ($0.kind, $0.path) = ("model", "a/b \"c\".usdz") }
    #expect(written.line == #"{"event":"written","kind":"model","path":"a/b \"c\".usdz"}"#)
  }

  /// Programs read these names: a change breaks them.
  @Test func keysAreStable() throws {
    let event = RunEvent("ended") { event in
      (event.dataset, event.fraction, event.stage) = ("a", 0.5, .triangulation)
      (event.remainingSeconds, event.sample, event.reason) = (1, 2, "b")
      (event.kind, event.path, event.message, event.isTransient) = ("c", "d", "e", true)
      (event.seconds, event.photos, event.registered, event.triangles) = (3, 4, 5, 6)
      (event.expectedSeconds, event.memoryBytes, event.diskBytes) = (7, 8, 9)
      (event.status, event.attempts, event.datasets, event.done) = (.skipped, 10, 11, 12)
      (event.skipped, event.failed, event.cancelled) = (13, 14, 15)
    }
    let object = try JSONSerialization.jsonObject(with: Data(event.line.utf8)) as? [String: Any]
    #expect(
      object?.keys.sorted() == [
        "attempts", "cancelled", "dataset", "datasets", "diskBytes", "done", "event",
        "expectedSeconds", "failed", "fraction", "isTransient", "kind", "memoryBytes", "message",
        "path", "photos", "reason", "registered", "remainingSeconds", "sample", "seconds",
        "skipped", "stage", "status", "triangles",
      ])
    #expect(RunEvent(line: event.line.utf8) == event)
  }

  @Test(arguments: ["", "{}", "progress", #"{"event":1}"#, #"{"event":"a","status":"b"}"#])
  func otherLinesAreNoEvents(_ line: String) {
    #expect(RunEvent(line: line.utf8) == nil)
  }

  @Test func stagesHaveTheNamesOfTheSession() {
    #expect(
      RunStage.allCases.map(\.rawValue) == [
        "frameSelection", "preProcessing", "imageAlignment", "pointCloudGeneration",
        "meshGeneration", "textureMapping", "optimization", "triangulation",
      ])
  }
}

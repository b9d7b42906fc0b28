import Foundation
import TestSupport
import Testing

@testable import photogrammetry_cli

@Suite struct BatchResultTests {
  private let log = URL(fileURLWithPath: "/nowhere/log")

  @Test func endsOfRuns() {
    let complete = RunEvent(event: "complete", photos: 20, registered: 18, triangles: 5)
    let done = BatchResult(.ended(code: 0, last: complete), log: log)
    #expect(done.status == .done && done.counts?.registered == 18 && !done.mayPass)
    let failed = RunEvent(event: "failed", message: "Too few. Take more.", mayPass: false)
    let lasting = BatchResult(.ended(code: 1, last: failed), log: log)
    #expect(lasting.status == .failed && lasting.error == "Too few. Take more.")
    #expect(!lasting.mayPass)
    let stopped = BatchResult(.ended(code: 130, last: nil), log: log)
    #expect(stopped.status == .cancelled && !stopped.mayPass)
  }

  @Test func whatMayPassIsTriedAgain() throws {
    let killed = BatchResult(.killed(signal: 9), log: log)
    #expect(killed.status == .failed && killed.mayPass)
    #expect(killed.error?.contains("memory") == true)
    let memory = RunEvent(event: "failed", message: "Little memory.", mayPass: true)
    #expect(BatchResult(.ended(code: 1, last: memory), log: log).mayPass)
    let temporary = try TemporaryFolder()
    let file = try temporary.write(Array("first\nlast words\n".utf8), as: "log")
    let silent = BatchResult(.ended(code: 66, last: nil), log: file)
    #expect(silent.mayPass && silent.error == "The run ended with code 66: last words")
    #expect(!BatchResult(.ended(code: 2, last: nil), log: file).mayPass)
  }

  @Test func attemptsAddUp() {
    var entry = BatchEntry(
      name: "a", status: .cancelled, photos: 3, model: "a.usdz", stamp: "")
    entry.take(BatchResult(.killed(signal: 9), log: log), seconds: 2)
    #expect(entry.status == .failed && entry.error != nil)
    let complete = RunEvent(event: "complete", photos: 4, registered: 3, triangles: 7)
    entry.take(BatchResult(.ended(code: 0, last: complete), log: log), seconds: 3)
    #expect(entry.status == .done && entry.error == nil)
    #expect((entry.attempts, entry.seconds, entry.photos, entry.triangles) == (2, 5, 4, 7))
  }
}

import Foundation
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite struct ChildResultTests {
  private let log = URL(fileURLWithPath: "/nowhere/log")

  @Test func endsOfRunsAreRecognized() {
    let complete = RunEvent("complete") { ($0.photos, $0.registered, $0.triangles) = (20, 18, 5) }
    let done = ChildResult(.ended(code: 0, last: complete), log: log)
    #expect(done.status == .done && done.counts?.registered == 18 && !done.isTransient)
    let failed = RunEvent("failed") {
      ($0.message, $0.isTransient) = ("Too few. Take more.", false)
    }
    let lasting = ChildResult(.ended(code: 1, last: failed), log: log)
    #expect(lasting.status == .failed && lasting.error == "Too few. Take more.")
    #expect(!lasting.isTransient)
    let stopped = ChildResult(.ended(code: 130, last: nil), log: log)
    #expect(stopped.status == .cancelled && !stopped.isTransient)
  }

  @Test func transientFailuresAreRecognized() throws {
    let killed = ChildResult(.killed(signal: 9), log: log)
    #expect(killed.status == .failed && killed.isTransient)
    #expect(killed.error?.contains("memory") == true)
    let memory = RunEvent("failed") {
      ($0.message, $0.isTransient) = ("Little memory.", true)
    }
    #expect(ChildResult(.ended(code: 1, last: memory), log: log).isTransient)
    let temporary = try TemporaryFolder()
    let file = try temporary.write("first\nlast words\n", as: "log")
    let silent = ChildResult(.ended(code: 66, last: nil), log: file)
    #expect(silent.error == "The run ended with code 66; see \(file.path): last words")
    #expect(silent.isTransient)
    #expect(!ChildResult(.ended(code: 2, last: nil), log: file).isTransient)
  }

  @Test func attemptsAddUp() {
    var entry = BatchEntry(
      name: "a", status: .cancelled, photos: 3, model: "a.usdz", fingerprint: "")
    entry.record(ChildResult(.killed(signal: 9), log: log), seconds: 2)
    #expect(entry.status == .failed && entry.error != nil)
    let complete = RunEvent("complete") { ($0.photos, $0.registered, $0.triangles) = (4, 3, 7) }
    entry.record(ChildResult(.ended(code: 0, last: complete), log: log), seconds: 3)
    #expect(entry.status == .done && entry.error == nil)
    #expect((entry.attempts, entry.seconds, entry.photos, entry.triangles) == (2, 5, 4, 7))
  }
}

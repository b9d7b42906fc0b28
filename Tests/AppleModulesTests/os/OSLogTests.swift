import Foundation
import OSLog
import Testing

@testable import os

@Suite struct OSLogTests {
  @Test func disabledLogsTakeNothing() {
    #expect(!OSLog.disabled.isEnabled(type: .error) && !OSLog.disabled.signpostsEnabled)
    #expect(!OSSignposter(logHandle: .disabled).isEnabled && !OSSignposter.disabled.isEnabled)
  }

  @Test func levelsAreThoseOfApple() {
    #expect(OSLogType.default.rawValue == 0 && OSLogType.info.rawValue == 1)
    #expect(OSLogType.debug.rawValue == 2 && OSLogType.error.rawValue == 16)
    #expect(OSLogType.fault.rawValue == 17)
    #expect(OSLog.Category.pointsOfInterest.rawValue == "PointsOfInterest")
  }

  @Test func thresholdsFollowTheLogger() {
    let logger = LogRecord().logger(level: .notice)
    let types: [OSLogType] = [.debug, .info, .default, .error, .fault]
    #expect(types.map { logger.isEnabled($0) } == [false, false, true, true, true])
  }

  @Test func intervalsAreLogged() throws {
    let record = LogRecord()
    let signposter = OSSignposter(logger: record.logger)
    #expect(signposter.isEnabled)
    let id = signposter.makeSignpostID()
    #expect(id != .null && id != .invalid && id != signposter.makeSignpostID())
    let state = signposter.beginInterval("Load", id: id, "photo \(5)")
    #expect(state.signpostID == id)
    signposter.endInterval("Load", state)
    signposter.emitEvent("Found", "\(2, format: .hex(includePrefix: true))")
    let result = signposter.withIntervalSignpost("Work") { 7 }
    #expect(result == 7)
    let lines = record.lines
    try #require(lines.count == 5)
    #expect(lines[0] == "trace Load begins photo 5" && lines[2] == "trace Found 0x2")
    let end = try #require(lines[1].wholeMatch(of: /trace Load ends after (\d+\.\d{3}) s/))
    #expect(try #require(Double(end.1)) < 60)
    #expect(lines[3] == "trace Work begins" && lines[4].hasPrefix("trace Work ends after "))
  }

  @Test func intervalsEndWhenWorkFails() {
    let record = LogRecord()
    #expect(throws: CocoaError.self) {
      try OSSignposter(logger: record.logger).withIntervalSignpost("Work") {
        throw CocoaError(.fileNoSuchFile)
      }
    }
    #expect(record.lines.count == 2)
  }

  @Test func identifiersOfObjectsAreStable() {
    let (a, b) = (NSObject(), NSObject())
    let signposter = OSSignposter.disabled
    #expect(signposter.makeSignpostID(from: a) == signposter.makeSignpostID(from: a))
    #expect(signposter.makeSignpostID(from: a) != signposter.makeSignpostID(from: b))
    #expect(OSSignpostID(3) < OSSignpostID(4) && OSSignpostID(rawValue: 3) == OSSignpostID(3))
    #expect(OSSignpostID.invalid.rawValue == .max && OSSignpostID.null.rawValue == 0)
    #expect(OSSignpostID.exclusive.rawValue == 0xEEEE_B0B5_B2B2_EEEE)
  }
}

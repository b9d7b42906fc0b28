import Foundation
import Testing

@testable import os

@Suite struct LoggerTests {
  private func text(_ message: OSLogMessage) -> String { message.interpolation.text }

  @Test func levelsMapToSwiftLog() {
    let record = LogRecord()
    let logger = record.logger
    logger.trace("1")
    logger.debug("2")
    logger.info("3")
    logger.log("4")
    logger.notice("5")
    logger.warning("6")
    logger.error("7")
    logger.critical("8")
    logger.fault("9")
    for type in [OSLogType.default, .info, .debug, .error, .fault] { logger.log(level: type, "x") }
    #expect(
      record.lines == [
        "trace 1", "debug 2", "info 3", "notice 4", "notice 5", "warning 6", "error 7",
        "critical 8", "critical 9", "notice x", "info x", "debug x", "error x", "critical x",
      ])
  }

  @Test func valuesOfManyTypesAreInterpolated() {
    let (name, count, share, isDone) = ("boot", 3, 0.25, true)
    #expect(text("\(name) \(count) \(share) \(isDone)") == "boot 3 0.250000 true")
    #expect(text("\(Float(1.5)) \(UInt8(7)) \(CGFloat(2))") == "1.500000 7 2.000000")
    #expect(text("\([1, 2]) \(Int.self)") == "[1, 2] Int")
    #expect(text("\(URL(fileURLWithPath: "/a/b"))").contains("/a/b"))
    #expect(text("\(CocoaError(.fileNoSuchFile) as any Error)").contains("CocoaError"))
    #expect(text("nothing but text") == "nothing but text")
  }

  @Test func onlyValuesMarkedPrivateAreRedacted() {
    let secret = "secret"
    #expect(text("\(secret, privacy: .public) \(secret, privacy: .auto)") == "secret secret")
    #expect(text("\(secret, privacy: .private)") == "<private>")
    #expect(text("\(5, privacy: .sensitive)") == "<private>")
    let masked = text("\(secret, privacy: .private(mask: .hash))")
    #expect(masked.hasPrefix("<mask.hash: ") && !masked.contains(secret))
    #expect(masked == text("\(secret, privacy: .sensitive(mask: .hash))"))
    #expect(masked != text("\("other", privacy: .private(mask: .hash))"))
  }

  @Test func formatsAndAlignmentAreApplied() {
    #expect(text("\(255, format: .hex) \(8, format: .octal)") == "ff 10")
    #expect(text("\(255, format: .hex(includePrefix: true, uppercase: true))") == "0xFF")
    #expect(text("\(7, format: .decimal(explicitPositiveSign: true, minDigits: 3))") == "+007")
    #expect(text("\(-7, format: .decimal(minDigits: 2))") == "-07")
    #expect(text("\(3.14159, format: .fixed(precision: 2))") == "3.14")
    #expect(text("\(Float(1234.5), format: .exponential(precision: 1))") == "1.2e+03")
    #expect(text("\(0.5, format: .hybrid, privacy: .public)") == "0.5")
    #expect(text("\(true, format: .answer)") == "YES")
    #expect(text("|\("ab", align: .right(columns: 4))|") == "|  ab|")
    #expect(text("|\(5, align: .left(columns: 3))|") == "|5  |")
  }

  @Test func locksProtectTheirValue() async {
    let lock = OSAllocatedUnfairLock(initialState: 0)
    await withTaskGroup(of: Void.self) { group in
      for _ in 0..<8 {
        group.addTask { for _ in 0..<1000 { lock.withLock { $0 += 1 } } }
      }
    }
    #expect(lock.withLock { $0 } == 8000)
    #expect(lock.withLockIfAvailable { $0 } == 8000)
    let plain = OSAllocatedUnfairLock()
    plain.lock()
    #expect(!plain.lockIfAvailable())
    plain.unlock()
    #expect(plain.withLock { 5 } == 5)
  }
}

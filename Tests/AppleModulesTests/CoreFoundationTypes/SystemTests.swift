import CoreFoundationTypes
import CoreMotion
import Foundation
import QuartzCore
import Testing

@Suite struct SystemTests {
  @Test func activitiesRunTheirWork() {
    let process = ProcessInfo.processInfo
    var isDone = false
    process.performActivity(options: .userInitiated, reason: "test") { isDone = true }
    #expect(isDone)
    let activity = process.beginActivity(options: .background, reason: "test")
    process.endActivity(activity)
    #expect(!process.isLowPowerModeEnabled)
  }

  @Test func activityOptionsHaveApplesBits() {
    typealias Options = ProcessInfo.ActivityOptions
    #expect(Options.idleSystemSleepDisabled.rawValue == 0x10_0000)
    #expect(Options.idleDisplaySleepDisabled.rawValue == 0x100_0000_0000)
    #expect(Options.userInitiated.rawValue == 0xFF_FFFF)
    #expect(Options.userInitiated.contains(.idleSystemSleepDisabled))
    let allowing = Options.userInitiatedAllowingIdleSystemSleep
    #expect(allowing.union(.idleSystemSleepDisabled) == .userInitiated)
    #expect(!allowing.contains(.idleSystemSleepDisabled))
    #expect(ProcessInfo.ThermalState.critical.rawValue == 3)
  }

  @Test func numbersBridgeToCGFloat() {
    let values: [String: Any] = ["a": NSNumber(value: 1.5), "b": NSNumber(value: 2), "c": "3"]
    #expect(values["a"] as? CGFloat == 1.5 && values["b"] as? CGFloat == 2)
    #expect(values["c"] as? CGFloat == nil)
    #expect((CGFloat(2.5) as NSNumber).doubleValue == 2.5)
  }

  @Test func memoryIsZeroedAndBounded() {
    let storage = PixelStorage(byteCount: 4)
    #expect(storage.copy(0..<4) == [0, 0, 0, 0])
    storage.write([1, 2, 3], at: 2)
    storage.write([9], at: 4)
    storage.write([9], at: -1)
    #expect(storage.copy(0..<9) == [0, 0, 1, 2] && storage.copy(3..<4) == [2])
    #expect(PixelStorage(byteCount: -5).byteCount == 0)
  }

  @Test func borrowedMemoryIsUsedInPlace() {
    var bytes: [UInt8] = [1, 2, 3, 4]
    bytes.withUnsafeMutableBytes { buffer in
      guard let base = buffer.baseAddress else { return }
      let storage = PixelStorage(borrowing: base + 1, byteCount: 2)
      #expect(storage.copy(0..<4) == [2, 3] && storage.baseAddress == base + 1)
      storage.write([8, 9, 10], at: 0)
    }
    #expect(bytes == [1, 8, 9, 4])
  }

  @Test func mediaTimeIsTheUptimeInSeconds() throws {
    let text = try String(contentsOfFile: "/proc/uptime", encoding: .utf8)
    let uptime = try #require(text.split(separator: " ").first.flatMap { Double($0) })
    let first = CACurrentMediaTime()
    // The kernel rounds to hundredths, and may count the time of sleep.
    #expect(first > 0 && first <= uptime + 5)
    usleep(20_000)
    #expect(CACurrentMediaTime() - first >= 0.02)
  }

  @Test func processTimesAndTerminalsAreReported() {
    var usage = rusage()
    #expect(getrusage(RUSAGE_SELF, &usage) == 0 && usage.ru_maxrss > 1000)
    var size = winsize()
    // A closed descriptor has no terminal.
    #expect(ioctl(-1, Int32(TIOCGWINSZ), &size) == -1)
  }

  @Test func freeSpaceHasApplesNames() throws {
    let values = try FileManager.default.temporaryDirectory.resourceValues(forKeys: [
      .volumeAvailableCapacityForImportantUsageKey,
      .volumeAvailableCapacityForOpportunisticUsageKey,
    ])
    let capacity = try #require(values.volumeAvailableCapacity)
    #expect(values.volumeAvailableCapacityForImportantUsage == Int64(capacity))
    #expect(values.volumeAvailableCapacityForOpportunisticUsage == Int64(capacity))
  }

  @Test func errorsPassThroughAutoreleasepool() {
    #expect(autoreleasepool { 5 } == 5)
    #expect(throws: CocoaError.self) {
      try autoreleasepool { throw CocoaError(.fileNoSuchFile) }
    }
    #expect(kCFBooleanTrue && !kCFBooleanFalse && kCFAllocatorDefault == nil)
  }

  @Test func accelerationsCompareByComponents() {
    let gravity = CMAcceleration(x: 0, y: -1, z: 0.5)
    #expect(gravity.x == 0 && gravity.y == -1 && gravity.z == 0.5)
    #expect(CMAcceleration() == CMAcceleration(x: 0, y: 0, z: 0) && gravity != CMAcceleration())
  }
}

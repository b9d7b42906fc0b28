import Foundation

// What programs for the Mac tell the system of long work, and ask it.

extension ProcessInfo {
  /// What an activity asks the system for.
  public struct ActivityOptions: OptionSet, Sendable {
    /// The bits of the set.
    public let rawValue: UInt64

    /// Creates a set from its bits.
    public init(rawValue: UInt64) { self.rawValue = rawValue }

    /// The display stays on.
    public static let idleDisplaySleepDisabled = ActivityOptions(rawValue: 1 << 40)
    /// The machine stays awake.
    public static let idleSystemSleepDisabled = ActivityOptions(rawValue: 1 << 20)
    /// The program isn't ended at once.
    public static let suddenTerminationDisabled = ActivityOptions(rawValue: 1 << 14)
    /// The program isn't ended while it has no windows.
    public static let automaticTerminationDisabled = ActivityOptions(rawValue: 1 << 15)
    /// The user waits for it.
    public static let userInitiated = ActivityOptions(rawValue: 0x00FF_FFFF)
    /// The user waits for it, while the machine may sleep.
    public static let userInitiatedAllowingIdleSystemSleep = ActivityOptions(
      rawValue: 0x00FF_FFFF & ~(1 << 20))
    /// Nobody waits for it.
    public static let background = ActivityOptions(rawValue: 0xFF)
    /// Timers are to be exact.
    public static let latencyCritical = ActivityOptions(rawValue: 0xFF_0000_0000)
  }

  /// Names some long work. No service here takes such requests, so the machine sleeps when it would.
  public func beginActivity(
    options: ActivityOptions = [], reason: String
  ) -> any NSObjectProtocol { NSString(string: reason) }

  /// Ends an activity.
  public func endActivity(_ activity: any NSObjectProtocol) {}

  /// Does some work as an activity.
  public func performActivity(
    options: ActivityOptions = [], reason: String, using block: () -> Void
  ) { block() }

  /// Has no effect: programs aren't ended at once here.
  public func disableSuddenTermination() {}

  /// Has no effect: programs aren't ended at once here.
  public func enableSuddenTermination() {}

  /// There is no such mode.
  public var isLowPowerModeEnabled: Bool { false }

  /// How hot the machine is.
  public enum ThermalState: Int, Hashable, Sendable {
    /// As usual.
    case nominal
    /// Warm: the machine cools itself more.
    case fair
    /// Hot: the machine slows down.
    case serious
    /// Too hot.
    case critical
  }

  /// Posted when the machine gets hotter or cooler, which nobody does here.
  public static let thermalStateDidChangeNotification = NSNotification.Name(
    "NSProcessInfoThermalStateDidChangeNotification")

  /// How hot the machine is, as the kernel measures it; `nominal` where it doesn't.
  public var thermalState: ThermalState {
    let root = "/sys/class/thermal"
    let zones = (try? FileManager.default.contentsOfDirectory(atPath: root)) ?? []
    return zones.filter { $0.hasPrefix("thermal_zone") }
      .map { ThermalZone(path: "\(root)/\($0)").state }
      .max { $0.rawValue < $1.rawValue } ?? .nominal
  }
}

/// One place of the machine that is measured, with the temperatures at which something is done.
private struct ThermalZone {
  let path: String

  var state: ProcessInfo.ThermalState {
    guard let temperature = number("temp") else { return .nominal }
    let passed = (0..<16).compactMap { index -> ProcessInfo.ThermalState? in
      guard let limit = number("trip_point_\(index)_temp"), limit > 0, temperature >= limit else {
        return nil
      }
      switch text("trip_point_\(index)_type") {
      case "critical": return .critical
      case "hot": return .serious
      case "passive": return .fair
      default: return nil
      }
    }
    return passed.max { $0.rawValue < $1.rawValue } ?? .nominal
  }

  private func text(_ file: String) -> String? {
    (try? String(contentsOfFile: "\(path)/\(file)", encoding: .utf8))?
      .trimmingCharacters(in: .whitespacesAndNewlines)
  }

  private func number(_ file: String) -> Int? { text(file).flatMap { Int($0) } }
}

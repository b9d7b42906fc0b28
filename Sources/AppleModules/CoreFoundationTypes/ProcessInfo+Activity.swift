import Foundation

// The activity and thermal API with which programs for macOS announce long work.

extension ProcessInfo {
  /// What an activity requests from the system.
  public struct ActivityOptions: OptionSet, Sendable {
    /// The bits of the set.
    public let rawValue: UInt64

    /// Creates a set from its bits.
    public init(rawValue: UInt64) { self.rawValue = rawValue }

    /// The display does not sleep.
    public static let idleDisplaySleepDisabled = ActivityOptions(rawValue: 1 << 40)
    /// The system does not sleep.
    public static let idleSystemSleepDisabled = ActivityOptions(rawValue: 1 << 20)
    /// The process is not terminated suddenly.
    public static let suddenTerminationDisabled = ActivityOptions(rawValue: 1 << 14)
    /// The process is not terminated automatically while it has no windows.
    public static let automaticTerminationDisabled = ActivityOptions(rawValue: 1 << 15)
    /// Work that the user waits for.
    public static let userInitiated = ActivityOptions(rawValue: 0x00FF_FFFF)
    /// Work that the user waits for, while the system may sleep.
    public static let userInitiatedAllowingIdleSystemSleep = ActivityOptions(
      rawValue: 0x00FF_FFFF & ~(1 << 20))
    /// Background work.
    public static let background = ActivityOptions(rawValue: 0xFF)
    /// Timers need high precision.
    public static let latencyCritical = ActivityOptions(rawValue: 0xFF_0000_0000)
  }

  /// Begins an activity. Has no effect: sleep is not prevented here.
  public func beginActivity(
    options: ActivityOptions = [], reason: String
  ) -> any NSObjectProtocol { NSString(string: reason) }

  /// Ends an activity; has no effect.
  public func endActivity(_ activity: any NSObjectProtocol) {}

  /// Calls a closure as an activity.
  public func performActivity(
    options: ActivityOptions = [], reason: String, using block: () -> Void
  ) { block() }

  /// Has no effect: there is no sudden termination here.
  public func disableSuddenTermination() {}

  /// Has no effect: there is no sudden termination here.
  public func enableSuddenTermination() {}

  /// Always false: there is no such mode here.
  public var isLowPowerModeEnabled: Bool { false }

  /// The thermal state of the machine.
  public enum ThermalState: Int, Hashable, Sendable {
    /// Normal.
    case nominal
    /// Elevated: cooling is increased.
    case fair
    /// High: the machine reduces its speed.
    case serious
    /// Critical.
    case critical
  }

  /// The name of the notification about a change of the thermal state; never posted here.
  public static let thermalStateDidChangeNotification = NSNotification.Name(
    "NSProcessInfoThermalStateDidChangeNotification")

  /// The thermal state according to the kernel's trip points; `nominal` if it reports none.
  public var thermalState: ThermalState {
    let root = "/sys/class/thermal"
    let zones = (try? FileManager.default.contentsOfDirectory(atPath: root)) ?? []
    return zones.filter { $0.hasPrefix("thermal_zone") }
      .map { ThermalZone(path: "\(root)/\($0)").state }
      .max { $0.rawValue < $1.rawValue } ?? .nominal
  }
}

/// A thermal zone of the kernel's sysfs with its trip points, in millidegrees Celsius.
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

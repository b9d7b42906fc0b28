import Foundation

/// A unit of time: its length in seconds and its English names.
struct DurationUnit {
  let unit: NSCalendar.Unit
  let seconds: Double
  let abbreviation: String
  let short: String
  let full: String
  /// Whether the short name takes a plural s.
  let hasShortPlural: Bool
  /// The unit's value in date components.
  let value: (DateComponents) -> Int?

  /// All units, longest first.
  static var all: [DurationUnit] {
    [
      DurationUnit(.year, 31_536_000, "y", "yr", "year", true) { $0.year },
      DurationUnit(.month, 2_592_000, "mo", "mth", "month", true) { $0.month },
      DurationUnit(.weekOfMonth, 604_800, "w", "wk", "week", true) { $0.weekOfMonth },
      DurationUnit(.day, 86_400, "d", "day", "day", true) { $0.day },
      DurationUnit(.hour, 3600, "h", "hr", "hour", false) { $0.hour },
      DurationUnit(.minute, 60, "m", "min", "minute", false) { $0.minute },
      DurationUnit(.second, 1, "s", "sec", "second", false) { $0.second },
    ]
  }

  private init(
    _ unit: NSCalendar.Unit, _ seconds: Double, _ abbreviation: String, _ short: String,
    _ full: String, _ hasShortPlural: Bool, value: @escaping (DateComponents) -> Int?
  ) {
    (self.unit, self.seconds, self.abbreviation, self.short) = (unit, seconds, abbreviation, short)
    (self.full, self.hasShortPlural, self.value) = (full, hasShortPlural, value)
  }

  func text(_ count: Double, _ style: DateComponentsFormatter.UnitsStyle) -> String {
    let digits = Self.digits(count)
    let plural = count == 1 ? "" : "s"
    return switch style {
    case .positional: digits
    case .abbreviated: digits + abbreviation
    case .short: "\(digits) \(short)\(hasShortPlural ? plural : "")"
    case .brief: "\(digits)\(short)\(hasShortPlural ? plural : "")"
    case .full: "\(digits) \(full)\(plural)"
    case .spellOut: "\(Self.words(count) ?? digits) \(full)\(plural)"
    }
  }

  static func digits(_ count: Double) -> String {
    count == count.rounded() ? String(format: "%.0f", count) : String(format: "%.1f", count)
  }

  private static func words(_ count: Double) -> String? {
    let formatter = NumberFormatter()
    formatter.numberStyle = .spellOut
    formatter.locale = Locale(identifier: "en_US")
    return formatter.string(from: NSNumber(value: count))
  }
}

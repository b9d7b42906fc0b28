import Foundation

/// Formats a duration in English. Foundation on Linux lacks this type.
///
/// Units have fixed lengths: a month has 30 days and a year 365.
open class DateComponentsFormatter: Formatter, @unchecked Sendable {
  /// How numbers and units are written.
  public enum UnitsStyle: Int, Hashable, Sendable {
    /// 1:02:03
    case positional
    /// 1h 2m 3s
    case abbreviated
    /// 1 hr, 2 min, 3 sec
    case short
    /// 1 hour, 2 minutes, 3 seconds
    case full
    /// one hour, two minutes, three seconds
    case spellOut
    /// 1hr 2min 3sec
    case brief
  }

  /// What happens to units that are zero.
  public struct ZeroFormattingBehavior: OptionSet, Sendable {
    /// The bits of the set.
    public let rawValue: UInt

    /// Creates a set from its bits.
    public init(rawValue: UInt) { self.rawValue = rawValue }

    /// With `positional`, leading zeros are dropped; with the other styles, all zeros.
    public static let `default` = ZeroFormattingBehavior(rawValue: 1 << 0)
    /// Leading zeros are dropped.
    public static let dropLeading = ZeroFormattingBehavior(rawValue: 1 << 1)
    /// Zeros in the middle are dropped.
    public static let dropMiddle = ZeroFormattingBehavior(rawValue: 1 << 2)
    /// Trailing zeros are dropped.
    public static let dropTrailing = ZeroFormattingBehavior(rawValue: 1 << 3)
    /// All zeros are dropped.
    public static let dropAll: ZeroFormattingBehavior = [.dropLeading, .dropMiddle, .dropTrailing]
    /// No zeros are dropped; with `positional`, each unit has at least two digits.
    public static let pad = ZeroFormattingBehavior(rawValue: 1 << 16)
  }

  /// The units to use. If empty: the units of the components, or all units for an interval.
  open var allowedUnits: NSCalendar.Unit = []
  /// How numbers and units are written.
  open var unitsStyle = UnitsStyle.positional
  /// What happens to units that are zero.
  open var zeroFormattingBehavior = ZeroFormattingBehavior.default
  /// The maximum number of units; 0 means no limit.
  open var maximumUnitCount = 0
  /// Whether the last unit may have a fraction.
  open var allowsFractionalUnits = false
  /// Whether a largest unit of 1 is merged into the next smaller unit.
  open var collapsesLargestUnit = false
  /// Whether the text starts with "About".
  open var includesApproximationPhrase = false
  /// Whether the text ends with "remaining".
  open var includesTimeRemainingPhrase = false
  /// The calendar of the components; has no effect here.
  open var calendar: Calendar? = .current
  /// The date that the components are relative to; has no effect here.
  open var referenceDate: Date?

  /// Creates a formatter with the style `positional`.
  public override init() { super.init() }

  /// Creates a formatter from an archive.
  public required init?(coder: NSCoder) { super.init(coder: coder) }

  /// Formats an interval in seconds; nil if it is not finite.
  open func string(from ti: TimeInterval) -> String? {
    guard ti.isFinite, abs(ti) < 1e15 else { return nil }
    return DurationText(self, seconds: ti, defaultUnits: DurationUnit.all).text
  }

  /// Formats the interval between two dates.
  open func string(from startDate: Date, to endDate: Date) -> String? {
    string(from: endDate.timeIntervalSince(startDate))
  }

  /// Formats date components.
  open func string(from components: DateComponents) -> String? {
    let units = DurationUnit.all.filter { $0.value(components) != nil }
    let seconds = units.reduce(0) { $0 + Double($1.value(components) ?? 0) * $1.seconds }
    return DurationText(self, seconds: seconds, defaultUnits: units).text
  }

  /// Formats a `DateComponents` value; nil for any other object.
  open override func string(for obj: Any?) -> String? {
    (obj as? DateComponents).flatMap { string(from: $0) }
  }

  /// Formats date components in a style.
  open class func localizedString(
    from components: DateComponents, unitsStyle: UnitsStyle
  ) -> String? {
    let formatter = DateComponentsFormatter()
    formatter.unitsStyle = unitsStyle
    return formatter.string(from: components)
  }
}

import Foundation

/// Writes how long something takes, in English: Foundation has the type, but not on Linux.
///
/// Calendar units up to weeks have a fixed length here; months and years need a calendar, so they are
/// counted as 30 and 365 days.
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

  /// What becomes of units that are zero.
  public struct ZeroFormattingBehavior: OptionSet, Sendable {
    /// The bits of the set.
    public let rawValue: UInt

    /// Creates a set from its bits.
    public init(rawValue: UInt) { self.rawValue = rawValue }

    /// In front they are left out where digits have places, and all of them where units have names.
    public static let `default` = ZeroFormattingBehavior(rawValue: 1 << 0)
    /// Those in front are left out.
    public static let dropLeading = ZeroFormattingBehavior(rawValue: 1 << 1)
    /// Those in between are left out.
    public static let dropMiddle = ZeroFormattingBehavior(rawValue: 1 << 2)
    /// Those at the end are left out.
    public static let dropTrailing = ZeroFormattingBehavior(rawValue: 1 << 3)
    /// All are left out.
    public static let dropAll: ZeroFormattingBehavior = [.dropLeading, .dropMiddle, .dropTrailing]
    /// All are written, and with two digits each where digits have places.
    public static let pad = ZeroFormattingBehavior(rawValue: 1 << 16)
  }

  /// The units that may be written; if it is empty, those of the components, or all.
  open var allowedUnits: NSCalendar.Unit = []
  /// How numbers and units are written.
  open var unitsStyle = UnitsStyle.positional
  /// What becomes of units that are zero.
  open var zeroFormattingBehavior = ZeroFormattingBehavior.default
  /// The number of units that are written at most; 0 is no bound.
  open var maximumUnitCount = 0
  /// Whether the last unit has a fraction.
  open var allowsFractionalUnits = false
  /// Whether the largest unit takes what larger ones would hold.
  open var collapsesLargestUnit = false
  /// Whether the text begins with "About".
  open var includesApproximationPhrase = false
  /// Whether the text ends with "remaining".
  open var includesTimeRemainingPhrase = false
  /// The calendar that components belong to.
  open var calendar: Calendar? = .current
  /// The moment that components count from.
  open var referenceDate: Date?

  /// Creates a formatter that writes digits.
  public override init() { super.init() }

  /// Creates a formatter; there are no archives of it.
  public required init?(coder: NSCoder) { super.init(coder: coder) }

  /// The text for a number of seconds.
  open func string(from ti: TimeInterval) -> String? {
    guard ti.isFinite, abs(ti) < 1e15 else { return nil }
    return DurationText(self, seconds: ti, unitsUnlessChosen: DurationUnit.all).text
  }

  /// The text for the time between two moments.
  open func string(from startDate: Date, to endDate: Date) -> String? {
    string(from: endDate.timeIntervalSince(startDate))
  }

  /// The text for components.
  open func string(from components: DateComponents) -> String? {
    let units = DurationUnit.all.filter { $0.value(components) != nil }
    let seconds = units.reduce(0) { $0 + Double($1.value(components) ?? 0) * $1.seconds }
    return DurationText(self, seconds: seconds, unitsUnlessChosen: units).text
  }

  /// The text for a date's components, as formatters have it.
  open override func string(for obj: Any?) -> String? {
    (obj as? DateComponents).flatMap { string(from: $0) }
  }

  /// The text for components in a style.
  open class func localizedString(
    from components: DateComponents, unitsStyle: UnitsStyle
  ) -> String? {
    let formatter = DateComponentsFormatter()
    formatter.unitsStyle = unitsStyle
    return formatter.string(from: components)
  }
}

/// A message for the log: a string whose interpolated values say how they are shown.
public struct OSLogMessage: ExpressibleByStringInterpolation {
  /// The text with its values.
  public let interpolation: OSLogInterpolation

  /// Creates a message from interpolated values.
  public init(stringInterpolation: OSLogInterpolation) { interpolation = stringInterpolation }

  /// Creates a message from a text.
  public init(stringLiteral value: String) {
    var interpolation = OSLogInterpolation(literalCapacity: value.utf8.count, interpolationCount: 0)
    interpolation.appendLiteral(value)
    self.interpolation = interpolation
  }
}

/// Whether a value may be read by everyone who sees the log.
///
/// A value is shown unless it is marked `private` or `sensitive`: unlike the log of a Mac, which all
/// programs share, this one goes to the user's own terminal.
public struct OSLogPrivacy: Hashable, Sendable {
  /// What is shown in the place of a value that isn't.
  public struct Mask: Hashable, Sendable {
    fileprivate let isHash: Bool

    /// A number that is the same for the same value, within one run.
    public static let hash = Mask(isHash: true)
    /// The value isn't told at all.
    public static let none = Mask(isHash: false)
  }

  fileprivate let isHidden: Bool
  fileprivate let mask: Mask

  /// The value is shown.
  public static let auto = OSLogPrivacy(isHidden: false, mask: .none)
  /// The value is shown.
  public static let `public` = OSLogPrivacy(isHidden: false, mask: .none)
  /// The value is not shown.
  public static let `private` = OSLogPrivacy(isHidden: true, mask: .none)
  /// The value is not shown.
  public static let sensitive = OSLogPrivacy(isHidden: true, mask: .none)

  /// The value is shown.
  public static func auto(mask: Mask) -> OSLogPrivacy { OSLogPrivacy(isHidden: false, mask: mask) }

  /// The value is not shown but by its mask.
  public static func `private`(mask: Mask) -> OSLogPrivacy {
    OSLogPrivacy(isHidden: true, mask: mask)
  }

  /// The value is not shown but by its mask.
  public static func sensitive(mask: Mask) -> OSLogPrivacy {
    OSLogPrivacy(isHidden: true, mask: mask)
  }

  func shown(_ text: String) -> String {
    guard isHidden else { return text }
    return mask.isHash ? "<mask.hash: \(String(text.hashValue.magnitude, radix: 16))>" : "<private>"
  }
}

/// How many columns a value takes, and on which side of them it stands.
public struct OSLogStringAlignment: Hashable, Sendable {
  fileprivate let columns: Int
  fileprivate let isRight: Bool

  /// As many columns as the value has characters.
  public static let none = OSLogStringAlignment(columns: 0, isRight: false)

  /// At least so many columns, the value to the left.
  public static func left(columns: @autoclosure () -> Int) -> OSLogStringAlignment {
    OSLogStringAlignment(columns: columns(), isRight: false)
  }

  /// At least so many columns, the value to the right.
  public static func right(columns: @autoclosure () -> Int) -> OSLogStringAlignment {
    OSLogStringAlignment(columns: columns(), isRight: true)
  }

  func aligned(_ text: String) -> String {
    let padding = String(repeating: " ", count: max(0, columns - text.count))
    return isRight ? padding + text : text + padding
  }
}

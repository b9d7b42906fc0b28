import Foundation

/// The format of an integer.
public struct OSLogIntegerFormatting: Hashable, Sendable {
  private let radix: Int
  private let prefix: String
  private let isUppercase: Bool
  private let hasPlus: Bool
  private let digits: Int

  /// Decimal.
  public static var decimal: OSLogIntegerFormatting { decimal() }
  /// Hexadecimal.
  public static var hex: OSLogIntegerFormatting { hex() }
  /// Octal.
  public static var octal: OSLogIntegerFormatting { octal() }

  /// Decimal, padded with zeros to `minDigits` digits.
  public static func decimal(
    explicitPositiveSign: Bool = false, minDigits: @autoclosure () -> Int = 1
  ) -> OSLogIntegerFormatting {
    OSLogIntegerFormatting(
      radix: 10, prefix: "", isUppercase: false, hasPlus: explicitPositiveSign, digits: minDigits())
  }

  /// Hexadecimal, padded with zeros to `minDigits` digits.
  public static func hex(
    explicitPositiveSign: Bool = false, includePrefix: Bool = false, uppercase: Bool = false,
    minDigits: @autoclosure () -> Int = 1
  ) -> OSLogIntegerFormatting {
    OSLogIntegerFormatting(
      radix: 16, prefix: includePrefix ? "0x" : "", isUppercase: uppercase,
      hasPlus: explicitPositiveSign, digits: minDigits())
  }

  /// Octal, padded with zeros to `minDigits` digits.
  public static func octal(
    explicitPositiveSign: Bool = false, includePrefix: Bool = false, uppercase: Bool = false,
    minDigits: @autoclosure () -> Int = 1
  ) -> OSLogIntegerFormatting {
    OSLogIntegerFormatting(
      radix: 8, prefix: includePrefix ? "0o" : "", isUppercase: uppercase,
      hasPlus: explicitPositiveSign, digits: minDigits())
  }

  func formatted(_ number: some BinaryInteger) -> String {
    let sign = number < 0 ? "-" : hasPlus ? "+" : ""
    let text = String(number.magnitude, radix: radix, uppercase: isUppercase)
    return sign + prefix + String(repeating: "0", count: max(0, digits - text.count)) + text
  }
}

/// The format of a floating-point number.
public struct OSLogFloatFormatting: Hashable, Sendable {
  private let specifier: Character
  private let precision: Int?
  private let isUppercase: Bool
  private let hasPlus: Bool

  private init(_ specifier: Character, _ precision: Int?, _ hasPlus: Bool, _ isUppercase: Bool) {
    (self.specifier, self.precision) = (specifier, precision)
    (self.hasPlus, self.isUppercase) = (hasPlus, isUppercase)
  }

  /// With six digits after the decimal point.
  public static var fixed: OSLogFloatFormatting { fixed() }
  /// As a hexadecimal fraction with an exponent.
  public static var hex: OSLogFloatFormatting { hex() }
  /// With an exponent.
  public static var exponential: OSLogFloatFormatting { exponential() }
  /// With an exponent if that is shorter.
  public static var hybrid: OSLogFloatFormatting { hybrid() }

  /// With six digits after the decimal point.
  public static func fixed(
    explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("f", nil, explicitPositiveSign, uppercase) }

  /// With `precision` digits after the decimal point.
  public static func fixed(
    precision: @autoclosure () -> Int, explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("f", precision(), explicitPositiveSign, uppercase) }

  /// As a hexadecimal fraction with an exponent.
  public static func hex(
    explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("a", nil, explicitPositiveSign, uppercase) }

  /// With an exponent.
  public static func exponential(
    explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("e", nil, explicitPositiveSign, uppercase) }

  /// With an exponent and `precision` digits after the decimal point.
  public static func exponential(
    precision: @autoclosure () -> Int, explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("e", precision(), explicitPositiveSign, uppercase) }

  /// With an exponent if that is shorter.
  public static func hybrid(
    explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("g", nil, explicitPositiveSign, uppercase) }

  /// With an exponent if that is shorter, and `precision` significant digits.
  public static func hybrid(
    precision: @autoclosure () -> Int, explicitPositiveSign: Bool = false, uppercase: Bool = false
  ) -> OSLogFloatFormatting { .init("g", precision(), explicitPositiveSign, uppercase) }

  func formatted(_ number: Double) -> String {
    let digits = precision.map { ".\(max(0, $0))" } ?? ""
    let text = String(format: "%\(hasPlus ? "+" : "")\(digits)\(specifier)", number)
    return isUppercase ? text.uppercased() : text
  }
}

/// The format of a Boolean.
public enum OSLogBoolFormat: Hashable, Sendable {
  /// true or false.
  case truth
  /// YES or NO.
  case answer

  func formatted(_ value: Bool) -> String {
    switch self {
    case .truth: value ? "true" : "false"
    case .answer: value ? "YES" : "NO"
    }
  }
}

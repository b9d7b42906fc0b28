import Foundation

/// Parses decimal numbers of text formats from bytes: much faster than via strings.
enum DecimalNumber {
  /// Powers of ten that doubles represent exactly: 5²² < 2⁵³.
  private static let powers: [Double] = (0...22).map { pow(10, Double($0)) }
  /// Integers of so many digits are exact, too. Limit: 10¹⁵ < 2⁵³ (IEEE 754).
  private static let exactDigits = 15
  /// Longer words are no numbers. Chosen: doubles are written with 24 characters at most.
  private static let maximumLength = 64

  /// The number at `offset`, which then is after it; nil without a number. Accepts `nan` and `inf`.
  static func parse(_ bytes: [UInt8], at offset: inout Int) -> Double? {
    let start = offset
    var position = offset
    var isNegative = false
    if position < bytes.count, bytes[position] == UInt8(ascii: "-") || bytes[position] == 43 {
      isNegative = bytes[position] == UInt8(ascii: "-")
      position += 1
    }
    var (mantissa, digits, exponent) = (0, 0, 0)
    var hasPoint = false
    while position < bytes.count {
      let byte = bytes[position]
      if byte &- 48 < 10 {
        if digits < 18 { mantissa = mantissa * 10 + Int(byte &- 48) }
        if mantissa > 0 { digits += 1 }
        if hasPoint { exponent -= 1 }
      } else if byte == UInt8(ascii: "."), !hasPoint {
        hasPoint = true
      } else {
        break
      }
      position += 1
    }
    let isSimple = position >= bytes.count || !isPartOfNumber(bytes[position])
    if isSimple, position - start > (hasPoint ? 1 : 0), digits <= exactDigits,
      exponent >= -22, position > start, bytes[position - 1] &- 48 < 10
    {
      offset = position
      let value = Double(mantissa) / powers[-exponent]
      return isNegative ? -value : value
    }
    return parseWord(bytes, at: &offset)
  }

  /// Whether a byte after digits can continue a number, such as the E of an exponent.
  private static func isPartOfNumber(_ byte: UInt8) -> Bool {
    byte &- 48 < 10 || (byte | 32) &- 97 < 26 || byte == 43 || byte == 45 || byte == 46
  }

  private static func parseWord(_ bytes: [UInt8], at offset: inout Int) -> Double? {
    let end = bytes[offset...].prefix(maximumLength).firstIndex { !isPartOfNumber($0) }
    let word = bytes[offset..<(end ?? min(bytes.count, offset + maximumLength))]
    // Without hexadecimal numbers.
    guard word.count < maximumLength, !word.contains(where: { $0 | 32 == UInt8(ascii: "x") }),
      let value = Double(String(decoding: word, as: UTF8.self))
    else { return nil }
    offset += word.count
    return value
  }
}

/// The lines of an untrusted text as words; a backslash at the end of a line continues it.
struct TextLines {
  let bytes: [UInt8]
  private(set) var offset = 0

  init(_ bytes: [UInt8]) { self.bytes = bytes }

  /// Moves to the start of the next line; false at the end of the text. The first call does so from
  /// anywhere in a line.
  mutating func skipLine() {
    while offset < bytes.count, bytes[offset] != UInt8(ascii: "\n") { offset += 1 }
    if offset < bytes.count { offset += 1 }
  }

  var isAtEnd: Bool { offset >= bytes.count }

  /// Skips spaces; false if the line ends.
  mutating func skipSpaces() -> Bool {
    while offset < bytes.count {
      let byte = bytes[offset]
      if byte == UInt8(ascii: " ") || byte == UInt8(ascii: "\t") || byte == UInt8(ascii: "\r") {
        offset += 1
      } else if byte == UInt8(ascii: "\\"), continuesLine() {
        skipLine()
      } else {
        return byte != UInt8(ascii: "\n")
      }
    }
    return false
  }

  private func continuesLine() -> Bool {
    let rest = bytes[(offset + 1)...].prefix(2)
    return rest.first == UInt8(ascii: "\n") || rest.elementsEqual(Array("\r\n".utf8))
  }

  /// The next word of the line; nil at its end.
  mutating func word() -> String? {
    guard skipSpaces() else { return nil }
    let start = offset
    while offset < bytes.count, bytes[offset] > 32 { offset += 1 }
    if offset == start { offset += 1 }
    return String(decoding: bytes[start..<offset], as: UTF8.self)
  }

  /// The next word as a number; nil at the end of the line, and for another word.
  mutating func number() -> Double? {
    guard skipSpaces() else { return nil }
    return DecimalNumber.parse(bytes, at: &offset)
  }

  /// Skips `byte` if it is next.
  mutating func skip(_ byte: UInt8) -> Bool {
    guard offset < bytes.count, bytes[offset] == byte else { return false }
    offset += 1
    return true
  }

  /// The next integer, without skipping spaces; nil without one.
  mutating func integer() -> Int? {
    var position = offset
    let isNegative = position < bytes.count && bytes[position] == UInt8(ascii: "-")
    if isNegative { position += 1 }
    let start = position
    var value = 0
    while position < bytes.count, bytes[position] &- 48 < 10, position - start < 18 {
      value = value * 10 + Int(bytes[position] &- 48)
      position += 1
    }
    guard position > start else { return nil }
    offset = position
    return isNegative ? -value : value
  }

  /// The rest of the line, without spaces at its ends.
  mutating func rest() -> String {
    _ = skipSpaces()
    let start = offset
    while offset < bytes.count, bytes[offset] != UInt8(ascii: "\n") { offset += 1 }
    return String(decoding: bytes[start..<offset], as: UTF8.self).trimmingSuffix { $0.isWhitespace }
  }
}

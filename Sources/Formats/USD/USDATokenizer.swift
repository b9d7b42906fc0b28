/// Splits untrusted USD text into tokens.
struct USDATokenizer {
  enum Token: Equatable {
    /// A name, keyword or type, possibly with colons, dots and `[]`.
    case word(String)
    case number(Double)
    case string(String)
    /// A path between at signs.
    case asset(String)
    /// A path between angle brackets.
    case path(String)
    case symbol(UInt8)
    case end
  }

  private let bytes: [UInt8]
  private var offset = 0

  init(_ bytes: [UInt8]) { self.bytes = bytes }

  /// The number of the current line, for messages.
  var line: Int { bytes[..<offset].count { $0 == UInt8(ascii: "\n") } + 1 }

  /// The next token; throws a `FormatFault`.
  mutating func next() throws -> Token {
    skipSpace()
    guard offset < bytes.count else { return .end }
    switch bytes[offset] {
    case UInt8(ascii: "\""), UInt8(ascii: "'"): return .string(try quoted())
    case UInt8(ascii: "@"): return .asset(try asset())
    case UInt8(ascii: "<"):
      offset += 1
      return .path(try text(upTo: [UInt8(ascii: ">")]))
    case UInt8(ascii: "0")...UInt8(ascii: "9"), UInt8(ascii: "-"), UInt8(ascii: "+"),
      UInt8(ascii: "."):
      guard let number = DecimalNumber.parse(bytes, at: &offset) else {
        throw FormatFault("line \(line) has an invalid number")
      }
      return .number(number)
    case let byte where Self.isName(byte): return word()
    case let byte:
      offset += 1
      return .symbol(byte)
    }
  }

  private mutating func word() -> Token {
    let start = offset
    while offset < bytes.count, Self.continuesName(bytes[offset]) { offset += 1 }
    if offset + 1 < bytes.count, bytes[offset] == UInt8(ascii: "["),
      bytes[offset + 1] == UInt8(ascii: "]")
    {
      offset += 2
    }
    switch String(decoding: bytes[start..<offset], as: UTF8.self) {
    case "nan": return .number(.nan)
    case "inf": return .number(.infinity)
    case let word: return .word(word)
    }
  }

  private mutating func skipSpace() {
    while offset < bytes.count {
      if bytes[offset] == UInt8(ascii: "#") {
        while offset < bytes.count, bytes[offset] != UInt8(ascii: "\n") { offset += 1 }
      } else if bytes[offset] <= 32 {
        offset += 1
      } else {
        return
      }
    }
  }

  /// A string between one or three quotation marks.
  private mutating func quoted() throws -> String {
    let mark = bytes[offset]
    let isLong = bytes[offset...].starts(with: [mark, mark, mark])
    let end = [UInt8](repeating: mark, count: isLong ? 3 : 1)
    offset += end.count
    var content: [UInt8] = []
    while offset < bytes.count {
      if bytes[offset] == UInt8(ascii: "\\"), offset + 1 < bytes.count {
        content.append(Self.unescaped(bytes[offset + 1]))
        offset += 2
      } else if bytes[offset] == mark, bytes[offset...].starts(with: end) {
        offset += end.count
        return String(decoding: content, as: UTF8.self)
      } else {
        content.append(bytes[offset])
        offset += 1
      }
    }
    throw FormatFault("a string has no end")
  }

  private static func unescaped(_ byte: UInt8) -> UInt8 {
    switch byte {
    case UInt8(ascii: "n"): 10
    case UInt8(ascii: "r"): 13
    case UInt8(ascii: "t"): 9
    default: byte
    }
  }

  private mutating func asset() throws -> String {
    let mark = UInt8(ascii: "@")
    let isLong = bytes[offset...].starts(with: [mark, mark, mark])
    offset += isLong ? 3 : 1
    return try text(upTo: [UInt8](repeating: mark, count: isLong ? 3 : 1))
  }

  private mutating func text(upTo end: [UInt8]) throws -> String {
    let start = offset
    while offset < bytes.count {
      if bytes[offset] == end[0], bytes[offset...].starts(with: end) {
        defer { offset += end.count }
        return String(decoding: bytes[start..<offset], as: UTF8.self)
      }
      offset += 1
    }
    throw FormatFault("a path has no end")
  }

  private static func isName(_ byte: UInt8) -> Bool {
    (byte | 32) &- 97 < 26 || byte == UInt8(ascii: "_") || byte >= 128
  }

  private static func continuesName(_ byte: UInt8) -> Bool {
    isName(byte) || byte &- 48 < 10 || byte == UInt8(ascii: ":") || byte == UInt8(ascii: ".")
  }
}

/// Compares runs of digits as numbers; names that differ only in case or leading zeros compare byte
/// by byte.
struct NaturalSortKey: Comparable {
  private enum Part: Equatable {
    case number(digits: [UInt8])
    case byte(UInt8)
  }

  private let parts: [Part]
  private let name: [UInt8]

  init(_ name: String) {
    self.name = Array(name.utf8)
    var parts: [Part] = []
    var digits: [UInt8]?
    for byte in name.lowercased().utf8 {
      if (UInt8(ascii: "0")...UInt8(ascii: "9")).contains(byte) {
        digits = (digits == [UInt8(ascii: "0")] ? [] : digits ?? []) + [byte]
      } else {
        if let digits { parts.append(.number(digits: digits)) }
        digits = nil
        parts.append(.byte(byte))
      }
    }
    if let digits { parts.append(.number(digits: digits)) }
    self.parts = parts
  }

  static func < (a: Self, b: Self) -> Bool {
    for (first, second) in zip(a.parts, b.parts) where first != second {
      switch (first, second) {
      case (.number(let x), .number(let y)):
        return x.count == y.count ? x.lexicographicallyPrecedes(y) : x.count < y.count
      case (.byte(let x), .byte(let y)): return x < y
      case (.number, .byte(let y)): return UInt8(ascii: "0") < y
      case (.byte(let x), .number): return x < UInt8(ascii: "0")
      }
    }
    if a.parts.count != b.parts.count { return a.parts.count < b.parts.count }
    return a.name.lexicographicallyPrecedes(b.name)
  }
}

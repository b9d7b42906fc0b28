/// Reads numbers from untrusted bytes; throws `Truncated` instead of reading past the end.
struct ByteCursor {
  /// The bytes end before the value does.
  struct Truncated: Error {}

  let bytes: [UInt8]
  private(set) var offset: Int
  let isBigEndian: Bool

  init(_ bytes: [UInt8], from offset: Int = 0, isBigEndian: Bool = false) {
    self.bytes = bytes
    self.offset = offset
    self.isBigEndian = isBigEndian
  }

  var remaining: Int { bytes.count - offset }

  /// Reads an unsigned integer of 1 to 8 bytes.
  mutating func unsigned(_ size: Int) throws -> UInt64 {
    guard remaining >= size else { throw Truncated() }
    var value: UInt64 = 0
    if isBigEndian {
      for index in 0..<size { value = value << 8 | UInt64(bytes[offset + index]) }
    } else {
      for index in 0..<size { value |= UInt64(bytes[offset + index]) << (8 * UInt64(index)) }
    }
    offset += size
    return value
  }
}

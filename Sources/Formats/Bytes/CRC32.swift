/// The CRC-32 checksum of zip and PNG: polynomial 0xEDB88320, reflected (ISO 3309).
package enum CRC32 {
  /// For four bytes at a time: `tables[k][b]` is the effect of byte b followed by k zero bytes.
  private static let tables: [[UInt32]] = {
    let first: [UInt32] = (0..<256).map { (index: UInt32) -> UInt32 in
      var value = index
      for _ in 0..<8 { value = (value >> 1) ^ (value & 1 != 0 ? 0xEDB8_8320 : 0) }
      return value
    }
    var tables = [first]
    for _ in 1..<4 {
      let last = tables[tables.count - 1]
      tables.append(last.map { ($0 >> 8) ^ first[Int($0 & 0xFF)] })
    }
    return tables
  }()

  /// The checksum of `bytes`.
  package static func checksum(_ bytes: [UInt8]) -> UInt32 {
    let (t0, t1, t2, t3) = (tables[0], tables[1], tables[2], tables[3])
    var value: UInt32 = 0xFFFF_FFFF
    var index = 0
    while index + 4 <= bytes.count {
      let low = UInt32(bytes[index]) | UInt32(bytes[index + 1]) << 8
      let high = UInt32(bytes[index + 2]) << 16 | UInt32(bytes[index + 3]) << 24
      value ^= low | high
      let early = t3[Int(value & 0xFF)] ^ t2[Int((value >> 8) & 0xFF)]
      value = early ^ t1[Int((value >> 16) & 0xFF)] ^ t0[Int(value >> 24)]
      index += 4
    }
    while index < bytes.count {
      value = (value >> 8) ^ t0[Int((value ^ UInt32(bytes[index])) & 0xFF)]
      index += 1
    }
    return ~value
  }
}

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

  /// Moves to an absolute position, at most the end.
  mutating func seek(to position: Int) throws {
    guard 0...bytes.count ~= position else { throw Truncated() }
    offset = position
  }

  /// Reads an unsigned integer of 8 bytes that is a count, a size or a position.
  mutating func count() throws -> Int {
    guard let value = Int(exactly: try unsigned(8)) else { throw Truncated() }
    return value
  }

  /// Reads the next `count` bytes.
  mutating func take(_ count: Int) throws -> ArraySlice<UInt8> {
    guard count >= 0, count <= remaining else { throw Truncated() }
    defer { offset += count }
    return bytes[offset..<offset + count]
  }

  /// Reads `count` little-endian numbers.
  mutating func values<Value: BitwiseCopyable>(_ type: Value.Type, count: Int) throws -> [Value] {
    let (size, overflow) = count.multipliedReportingOverflow(by: MemoryLayout<Value>.stride)
    guard !overflow, size >= 0 else { throw Truncated() }
    let source = try take(size)
    return [Value](unsafeUninitializedCapacity: count) { buffer, initializedCount in
      source.withUnsafeBytes { UnsafeMutableRawBufferPointer(buffer).copyMemory(from: $0) }
      initializedCount = count
    }
  }

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

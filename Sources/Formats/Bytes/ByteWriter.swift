/// A growing byte buffer; numbers are little-endian.
struct ByteWriter {
  private(set) var bytes: [UInt8] = []

  init(capacity: Int = 0) { bytes.reserveCapacity(capacity) }

  var count: Int { bytes.count }

  mutating func append(_ value: UInt8) { bytes.append(value) }

  mutating func append(_ value: UInt16) { append(integer: value) }

  mutating func append(_ value: UInt32) { append(integer: value) }

  mutating func append(_ value: UInt64) { append(integer: value) }

  private mutating func append(integer value: some FixedWidthInteger) {
    withUnsafeBytes(of: value.littleEndian) { bytes.append(contentsOf: $0) }
  }

  mutating func append(_ value: Int32) { append(UInt32(bitPattern: value)) }

  mutating func append(_ value: Int64) { append(UInt64(bitPattern: value)) }

  mutating func append(_ value: Float) { append(value.bitPattern) }

  mutating func append(_ value: Double) { append(value.bitPattern) }

  mutating func append(_ value: SIMD2<Float>) {
    append(value.x)
    append(value.y)
  }

  mutating func append(_ value: SIMD3<Float>) {
    let patterns = (
      value.x.bitPattern.littleEndian, value.y.bitPattern.littleEndian,
      value.z.bitPattern.littleEndian
    )
    withUnsafeBytes(of: patterns) { bytes.append(contentsOf: $0) }
  }

  mutating func append(_ value: SIMD3<UInt8>) {
    bytes.append(value.x)
    bytes.append(value.y)
    bytes.append(value.z)
  }

  mutating func append(_ text: String) { bytes.append(contentsOf: text.utf8) }

  mutating func append(contentsOf other: some Sequence<UInt8>) { bytes.append(contentsOf: other) }

  /// Appends zeros until the count is a multiple of `alignment`.
  mutating func align(to alignment: Int) {
    while bytes.count % alignment != 0 { bytes.append(0) }
  }

  /// Overwrites the eight bytes at `offset`.
  mutating func replace(at offset: Int, with value: Int64) {
    let pattern = UInt64(bitPattern: value)
    for index in 0..<8 {
      bytes[offset + index] = UInt8(truncatingIfNeeded: pattern >> (8 * UInt64(index)))
    }
  }
}

/// The lowest `count` bytes of a value, the most significant one first.
package func bigEndian(_ value: Int, _ count: Int = 4) -> [UInt8] {
  littleEndian(value, count).reversed()
}

/// The lowest `count` bytes of a value, the least significant one first.
package func littleEndian(_ value: Int, _ count: Int = 4) -> [UInt8] {
  (0..<count).map { UInt8(truncatingIfNeeded: value >> (8 * $0)) }
}

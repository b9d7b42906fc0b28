import SceneModel

/// Hashes all inputs of a result to a number that changes with any of them.
package struct Fingerprint {
  private var bytes: [UInt8] = []

  package init() {}

  /// Adds a value; the order of additions matters.
  package mutating func add(_ value: UInt64) {
    withUnsafeBytes(of: value.littleEndian) { bytes.append(contentsOf: $0) }
  }

  /// Adds a value by its bit pattern.
  package mutating func add(_ value: Int) { add(UInt64(bitPattern: Int64(value))) }
  /// Adds a value by its bit pattern; 0 and −0 differ.
  package mutating func add(_ value: Double) { add(value.bitPattern) }
  /// Adds the elements in order.
  package mutating func add(_ value: SIMD2<Double>) { for i in 0..<2 { add(value[i]) } }
  /// Adds the elements in order.
  package mutating func add(_ value: SIMD3<Double>) { for i in 0..<3 { add(value[i]) } }
  /// Adds the elements in order.
  package mutating func add(_ value: SIMD4<Double>) { for i in 0..<4 { add(value[i]) } }

  /// Adds a sequence with its length, so that its end is unambiguous.
  package mutating func add(_ content: some Collection<UInt8>) {
    add(content.count)
    bytes.append(contentsOf: content)
  }

  /// The XXH64 hash of all that was added.
  package var value: UInt64 { bytes.withUnsafeBytes { XXHash64.hash($0) } }
}

import SceneModel

/// Damaged copies of a valid file's bytes, for tests that every reader returns a value or throws an
/// error for them. The same file and seed give the same copies.
package struct DamagedInput: Sendable {
  /// The valid file.
  package let bytes: [UInt8]

  package init(_ bytes: [UInt8]) { self.bytes = bytes }

  /// The file cut off after 0 to `bytes.count − 1` bytes, all lengths or every `step`-th.
  package func truncations(step: Int = 1) -> some Sequence<[UInt8]> {
    stride(from: 0, to: bytes.count, by: step).lazy.map { Array(bytes.prefix($0)) }
  }

  /// `count` copies of which 1 to 6 bytes are replaced, inserted or removed. Half of the changes
  /// hit the first `header` bytes; new values are often extreme, because lengths and counts fail
  /// there.
  package func mutations(_ count: Int, seed: UInt64, header: Int = 64) -> some Sequence<[UInt8]> {
    (0..<count).lazy.map { index in
      var random = SplitMix64(seed: seed &+ UInt64(index) &* 0x9E37_79B9_7F4A_7C15)
      var copy = bytes
      for _ in 0...random.below(6) where !copy.isEmpty {
        Self.damage(&copy, within: header, &random)
      }
      return copy
    }
  }

  private static func damage(_ bytes: inout [UInt8], within header: Int, _ random: inout SplitMix64)
  {
    let limit = random.below(2) == 0 ? min(header, bytes.count) : bytes.count
    let place = random.below(max(limit, 1))
    switch random.below(8) {
    case 0: bytes.remove(at: place)
    case 1: bytes.insert(UInt8(random.below(256)), at: place)
    case 2, 3: bytes[place] ^= 1 << UInt8(random.below(8))
    case 4, 5: bytes[place] = [0, 1, 0x7F, 0x80, 0xFE, 0xFF][random.below(6)]
    default: bytes[place] = UInt8(random.below(256))
    }
  }
}

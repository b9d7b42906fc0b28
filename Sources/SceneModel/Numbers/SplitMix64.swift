/// A pseudorandom number generator with the same output on every machine for the same seed (Steele
/// et al., "Fast splittable pseudorandom number generators", OOPSLA 2014).
package struct SplitMix64: RandomNumberGenerator, Sendable {
  private var state: UInt64

  package init(seed: UInt64) { state = seed }

  package mutating func next() -> UInt64 {
    state &+= 0x9E37_79B9_7F4A_7C15
    var z = state
    z = (z ^ (z >> 30)) &* 0xBF58_476D_1CE4_E5B9
    z = (z ^ (z >> 27)) &* 0x94D0_49BB_1331_11EB
    return z ^ (z >> 31)
  }

  /// A random number in 0..<1.
  package mutating func uniform() -> Double { Double(next() >> 11) * 0x1p-53 }

  /// A random integer in 0..<`limit`.
  package mutating func below(_ limit: Int) -> Int { Int(next() % UInt64(limit)) }

  /// `count` distinct random integers in 0..<`limit`, at most `limit` of them.
  package mutating func distinct(_ count: Int, below limit: Int) -> [Int] {
    var numbers: [Int] = []
    while numbers.count < min(count, limit) {
      let number = below(limit)
      if !numbers.contains(number) { numbers.append(number) }
    }
    return numbers
  }
}

/// Bytes as one LZ4 block (LZ4 Block Format Description, Collet): compressed by greedy matching,
/// with a hash table of one candidate.
enum LZ4Block {
  /// The length of the shortest match. Limit: of the format.
  static let minimumMatch = 4
  /// Limit: the format requires the last five bytes as literals, and no match start in the last
  /// twelve.
  private static let literalTail = 5
  private static let tail = 12
  private static let maximumOffset = 0xFFFF
  /// Bits of an index of the hash table. Chosen.
  private static let hashBits: UInt32 = 15
  /// Knuth's multiplicative hash: 2³² divided by the golden ratio, rounded to a prime. Paper: Knuth
  /// 1998, The Art of Computer Programming, volume 3, section 6.4.
  private static let hashFactor: UInt32 = 2_654_435_761
  /// After every 2⁶ positions without a match the search advances by one byte more, so that
  /// incompressible data is skipped quickly. Chosen: that of the reference implementation.
  private static let accelerationShift = 6

  /// The block for `input`.
  static func compress(_ input: [UInt8]) -> [UInt8] {
    var output: [UInt8] = []
    output.reserveCapacity(input.count / 2 + 16)
    var table = [Int32](repeating: -1, count: 1 << hashBits)
    var anchor = 0
    var position = 0
    var misses = 0
    while position + tail < input.count {
      let word = word(input, position)
      let slot = Int((word &* hashFactor) >> (32 - hashBits))
      let candidate = Int(table[slot])
      table[slot] = Int32(truncatingIfNeeded: position)
      guard candidate >= 0, position - candidate <= maximumOffset,
        self.word(input, candidate) == word
      else {
        misses += 1
        position += 1 + misses >> accelerationShift
        continue
      }
      misses = 0
      var length = minimumMatch
      while position + length < input.count - literalTail,
        input[candidate + length] == input[position + length]
      { length += 1 }
      append(
        literals: input[anchor..<position], offset: position - candidate, length: length,
        to: &output)
      position += length
      anchor = position
    }
    append(lastLiterals: input[anchor...], to: &output)
    return output
  }

  private static func word(_ input: [UInt8], _ at: Int) -> UInt32 {
    let low = UInt32(input[at]) | UInt32(input[at + 1]) << 8
    return low | UInt32(input[at + 2]) << 16 | UInt32(input[at + 3]) << 24
  }

  private static func append(
    literals: ArraySlice<UInt8>, offset: Int, length: Int, to output: inout [UInt8]
  ) {
    let extra = length - minimumMatch
    output.append(UInt8(min(15, literals.count)) << 4 | UInt8(min(15, extra)))
    append(lengthBeyond15: literals.count, to: &output)
    output.append(contentsOf: literals)
    output.append(UInt8(offset & 0xFF))
    output.append(UInt8(offset >> 8))
    append(lengthBeyond15: extra, to: &output)
  }

  private static func append(lastLiterals: ArraySlice<UInt8>, to output: inout [UInt8]) {
    output.append(UInt8(min(15, lastLiterals.count)) << 4)
    append(lengthBeyond15: lastLiterals.count, to: &output)
    output.append(contentsOf: lastLiterals)
  }

  private static func append(lengthBeyond15 length: Int, to output: inout [UInt8]) {
    guard length >= 15 else { return }
    var rest = length - 15
    while rest >= 255 {
      output.append(255)
      rest -= 255
    }
    output.append(UInt8(rest))
  }
}

import Testing

@testable import Formats

@Suite struct CrateCompressionTests {
  static let inputs: [[UInt8]] = [
    [], [1], Array("hello".utf8), [UInt8](repeating: 7, count: 13),
    [UInt8](repeating: 0, count: 100_000),
    (0..<70_000).map { UInt8(truncatingIfNeeded: $0 / 3) },
    (0..<50_000).map { UInt8(truncatingIfNeeded: ($0 &* 2_654_435_761) >> 13) },
    Array(String(repeating: "points normals primvars:st ", count: 40).utf8),
  ]

  @Test(arguments: inputs.indices)
  func blocksDecompressToTheInput(_ index: Int) throws {
    let input = Self.inputs[index]
    #expect(try Self.decompress(LZ4Block.compress(input)) == input)
  }

  @Test func repetitiveInputIsCompressed() {
    #expect(LZ4Block.compress([UInt8](repeating: 0, count: 100_000)).count < 500)
  }

  @Test(
    arguments: [
      [], [5], [1, 2, 3, 4], [3, 3, 3, 3, 3], [0, 127, -1, -129, 40_000, -70_000, .max, .min, 0],
      (0..<1000).map { Int32($0 * $0) },
    ] as [[Int32]])
  func integersRoundTrip(_ integers: [Int32]) throws {
    let packed = CrateCompression.compress(integers)
    #expect(packed.first == 0)
    let bytes = try Self.decompress(Array(packed.dropFirst()))
    #expect(try Self.decode(bytes, count: integers.count) == integers)
  }

  /// Decompresses LZ4's block format, implemented directly from its specification.
  static func decompress(_ block: [UInt8]) throws -> [UInt8] {
    var output: [UInt8] = []
    var position = 0
    func length(_ nibble: UInt8) -> Int {
      var length = Int(nibble)
      guard length == 15 else { return length }
      var byte: UInt8
      repeat {
        byte = block[position]
        position += 1
        length += Int(byte)
      } while byte == 255
      return length
    }
    while position < block.count {
      let token = block[position]
      position += 1
      let literals = length(token >> 4)
      output += block[position..<(position + literals)]
      position += literals
      guard position < block.count else {
        try #require(block.count < 13 || literals >= 5)
        return output
      }
      let offset = Int(block[position]) | Int(block[position + 1]) << 8
      position += 2
      try #require(offset > 0 && offset <= output.count)
      for _ in 0..<(length(token & 15) + 4) { output.append(output[output.count - offset]) }
    }
    return output
  }

  /// Decodes the integer coding, implemented from its specification.
  static func decode(_ bytes: [UInt8], count: Int) throws -> [Int32] {
    var reader = ByteCursor(bytes)
    let common = Int32(bitPattern: UInt32(try reader.unsigned(4)))
    var codes: [UInt8] = []
    for _ in 0..<((2 * count + 7) / 8) { codes.append(UInt8(try reader.unsigned(1))) }
    var last: Int32 = 0
    let integers = try (0..<count).map { index in
      let difference: Int32 =
        switch codes[index / 4] >> UInt8(2 * (index % 4)) & 3 {
        case 0: common
        case 1: Int32(Int8(truncatingIfNeeded: try reader.unsigned(1)))
        case 2: Int32(Int16(truncatingIfNeeded: try reader.unsigned(2)))
        default: Int32(truncatingIfNeeded: try reader.unsigned(4))
        }
      last &+= difference
      return last
    }
    #expect(reader.remaining == 0)
    return integers
  }
}

/// The crate format's compression of bytes and integers.
enum CrateCompression {
  /// Maximum input size of one LZ4 block.
  private static let chunkSize = 0x7E00_0000

  /// Bytes as LZ4 blocks: a zero and one block, or the number of chunks and each with its length.
  static func compress(_ input: [UInt8]) -> [UInt8] {
    guard input.count > chunkSize else { return [0] + LZ4Block.compress(input) }
    var writer = ByteWriter()
    writer.append(UInt8((input.count + chunkSize - 1) / chunkSize))
    for start in stride(from: 0, to: input.count, by: chunkSize) {
      let end = min(input.count, start + chunkSize)
      let block = LZ4Block.compress(Array(input[start..<end]))
      writer.append(Int32(block.count))
      writer.append(contentsOf: block)
    }
    return writer.bytes
  }

  /// Delta encoding: the most frequent difference, a two-bit code for each integer (that
  /// difference, or one of 1, 2 or 4 bytes), then these bytes; all of it compressed.
  static func compress(_ integers: [Int32]) -> [UInt8] {
    var differences: [Int32] = []
    differences.reserveCapacity(integers.count)
    var last: Int32 = 0
    for value in integers {
      differences.append(value &- last)
      last = value
    }
    let common = mostFrequent(differences)
    var codes = [UInt8](repeating: 0, count: (integers.count * 2 + 7) / 8)
    var variable = ByteWriter(capacity: integers.count)
    for (index, difference) in differences.enumerated() where difference != common {
      let code: UInt8
      if let small = Int8(exactly: difference) {
        code = 1
        variable.append(UInt8(bitPattern: small))
      } else if let medium = Int16(exactly: difference) {
        code = 2
        variable.append(UInt16(bitPattern: medium))
      } else {
        code = 3
        variable.append(difference)
      }
      codes[index / 4] |= code << UInt8(2 * (index % 4))
    }
    var writer = ByteWriter(capacity: 4 + codes.count + variable.count)
    writer.append(common)
    writer.append(contentsOf: codes)
    writer.append(contentsOf: variable.bytes)
    return compress(writer.bytes)
  }

  /// The most frequent value, the largest on ties; zero for none.
  private static func mostFrequent(_ values: [Int32]) -> Int32 {
    var counts: [Int32: Int] = [:]
    for value in values { counts[value, default: 0] += 1 }
    return counts.max { ($0.value, $0.key) < ($1.value, $1.key) }?.key ?? 0
  }
}

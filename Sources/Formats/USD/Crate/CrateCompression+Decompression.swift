extension CrateCompression {
  /// Decompresses bytes, at most `maximumCount`. Throws a `FormatFault`, or
  /// `ByteCursor.Truncated`.
  static func decompress(_ input: ArraySlice<UInt8>, maximumCount: Int) throws -> [UInt8] {
    guard let chunks = input.first else { return [] }
    guard chunks > 0 else {
      return try LZ4Block.decompress(input.dropFirst(), maximumCount: maximumCount)
    }
    var cursor = ByteCursor(Array(input.dropFirst()))
    var output: [UInt8] = []
    for _ in 0..<chunks {
      let size = Int(try cursor.unsigned(4))
      output += try LZ4Block.decompress(
        try cursor.take(size), maximumCount: maximumCount - output.count)
    }
    return output
  }

  /// Decompresses `count` integers of 4 or 8 bytes: the inverse of `compress`; 8-byte integers use
  /// differences of 2, 4 or 8 bytes. Throws a `FormatFault`, or `ByteCursor.Truncated`.
  static func decompress<Number: FixedWidthInteger & SignedInteger>(
    _ input: ArraySlice<UInt8>, count: Int, as type: Number.Type
  ) throws -> [Number] {
    let width = Number.bitWidth / 8
    let codeSize = (count + 3) / 4
    let bytes = try decompress(input, maximumCount: width + codeSize + count * width)
    var cursor = ByteCursor(bytes)
    let common = Number(truncatingIfNeeded: try cursor.unsigned(width))
    let codes = try cursor.take(codeSize)
    var last: Number = 0
    var result: [Number] = []
    result.reserveCapacity(count)
    for index in 0..<count {
      switch codes[codes.startIndex + index / 4] >> UInt8(2 * (index % 4)) & 3 {
      case 0: last &+= common
      case 1: last &+= try difference(&cursor, width / 4)
      case 2: last &+= try difference(&cursor, width / 2)
      default: last &+= try difference(&cursor, width)
      }
      result.append(last)
    }
    return result
  }

  /// Reads a signed integer of `size` bytes.
  private static func difference<Number: FixedWidthInteger>(
    _ cursor: inout ByteCursor, _ size: Int
  ) throws -> Number {
    let shift = 64 - 8 * size
    return Number(
      truncatingIfNeeded: Int64(bitPattern: try cursor.unsigned(size) << shift) >> shift)
  }
}

extension LZ4Block {
  /// The largest ratio of decompressed to compressed size. Limit: a byte of a length stands for 255
  /// bytes.
  static let maximumRatio = 255

  /// Decompresses a block of which at most `maximumCount` bytes are expected. Throws a
  /// `FormatFault`.
  static func decompress(_ block: ArraySlice<UInt8>, maximumCount: Int) throws -> [UInt8] {
    let damaged = FormatFault("its compressed content is damaged")
    let bound = block.count.multipliedReportingOverflow(by: maximumRatio)
    // A few bytes can be shorter than their sequence, hence the margin.
    let capacity = min(maximumCount, bound.overflow ? .max : bound.partialValue + 64)
    guard capacity >= 0 else { throw damaged }
    return try [UInt8](unsafeUninitializedCapacity: capacity) { output, count in
      try block.withUnsafeBytes { input in
        var decoder = LZ4Decoder(input: input, output: output)
        guard decoder.run() else { throw damaged }
        count = decoder.written
      }
    }
  }
}

/// Decodes the sequences of an LZ4 block: literals, then a copy of earlier output.
private struct LZ4Decoder {
  let input: UnsafeRawBufferPointer
  let output: UnsafeMutableBufferPointer<UInt8>
  private var position = 0
  private(set) var written = 0

  init(input: UnsafeRawBufferPointer, output: UnsafeMutableBufferPointer<UInt8>) {
    (self.input, self.output) = (input, output)
  }

  /// False if the block is damaged or its content doesn't fit.
  mutating func run() -> Bool {
    while position < input.count {
      let token = Int(input[position])
      position += 1
      guard let literals = length(token >> 4), literals <= input.count - position,
        literals <= output.count - written
      else { return false }
      for index in 0..<literals { output[written + index] = input[position + index] }
      position += literals
      written += literals
      // The last sequence has literals only.
      if position == input.count { return true }
      guard copyMatch(token & 15) else { return false }
    }
    return true
  }

  private mutating func copyMatch(_ nibble: Int) -> Bool {
    guard input.count - position >= 2 else { return false }
    let offset = Int(input[position]) | Int(input[position + 1]) << 8
    position += 2
    guard let extra = length(nibble), offset > 0, offset <= written,
      extra + LZ4Block.minimumMatch <= output.count - written
    else { return false }
    // The source may overlap the destination, so that patterns repeat.
    for _ in 0..<extra + LZ4Block.minimumMatch {
      output[written] = output[written - offset]
      written += 1
    }
    return true
  }

  /// A length of which `nibble` are the first four bits; nil if the input ends.
  private mutating func length(_ nibble: Int) -> Int? {
    guard nibble == 15 else { return nibble }
    var length = nibble
    while position < input.count {
      let byte = input[position]
      position += 1
      length += Int(byte)
      if byte < 255 { return length }
    }
    return nil
  }
}

/// The chunks of a PNG (length, name, data, checksum) or WebP (name, length, data) file.
struct FileChunks: Sequence, IteratorProtocol {
  struct Chunk {
    var name: String
    /// Byte range of its data in the file.
    var data: Range<Int>
  }

  private let reader: ByteReader
  private let isPNG: Bool
  private var offset: Int

  init(png reader: ByteReader) {
    (self.reader, isPNG, offset) = (reader, true, 8)
  }

  init(webP reader: ByteReader) {
    (self.reader, isPNG, offset) = (reader, false, 12)
  }

  /// The next chunk; nil at the end of the file or at a truncated chunk.
  mutating func next() -> Chunk? {
    guard let length = reader.uint32(offset + (isPNG ? 0 : 4), isPNG ? .big : .little),
      let name = reader.text(at: offset + (isPNG ? 4 : 0), count: 4)
    else { return nil }
    let start = offset + 8
    guard length <= reader.bytes.count - start else { return nil }
    // PNG: a checksum follows. WebP: chunks start at even offsets.
    offset = start + length + (isPNG ? 4 : length & 1)
    return Chunk(name: name, data: start..<start + length)
  }
}

/// The chunks of a PNG (length, name, data, checksum) or WebP (name, length, data) file.
struct FileChunks: Sequence, IteratorProtocol {
  struct Chunk {
    var name: String
    /// Where its data is in the file.
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

  /// Ends where the file does, a chunk that is cut off included.
  mutating func next() -> Chunk? {
    guard let length = reader.uint32(offset + (isPNG ? 0 : 4), isPNG ? .big : .little),
      let name = reader.text(at: offset + (isPNG ? 4 : 0), count: 4)
    else { return nil }
    let start = offset + 8
    guard length <= reader.bytes.count - start else { return nil }
    // A checksum follows; or nothing, but chunks start at even places.
    offset = start + length + (isPNG ? 4 : length & 1)
    return Chunk(name: name, data: start..<start + length)
  }
}

/// The marker segments of a JPEG file up to the first scan.
package struct JPEGSegments: Sequence, IteratorProtocol {
  /// A marker segment.
  package struct Segment: Sendable {
    /// The second byte of the marker.
    package var marker: UInt8
    /// Offsets of the content in the file, without the two length bytes.
    package var payload: Range<Int>

    /// Whether this is a frame header: C0…CF except the tables C4, C8 and CC.
    package var isStartOfFrame: Bool {
      (0xC0...0xCF).contains(marker) && ![0xC4, 0xC8, 0xCC].contains(marker)
    }
  }

  private let reader: ByteReader
  private var offset = 2

  /// `reader` holds a whole JPEG file.
  package init(_ reader: ByteReader) { self.reader = reader }

  /// The next segment; nil at the first scan, the end of the image, or damage.
  package mutating func next() -> Segment? {
    while let byte = reader.byte(offset), let following = reader.byte(offset + 1) {
      // Decoders skip stray bytes between segments, and fill bytes before a marker.
      if byte != 0xFF || following == 0xFF || following == 0 {
        offset += 1
        continue
      }
      let marker = UInt8(following)
      if (0xD0...0xD8).contains(marker) || marker == 0x01 {
        offset += 2
        continue
      }
      if marker == 0xD9 || marker == 0xDA { return nil }
      guard let length = reader.uint16(offset + 2, .big), length >= 2 else { return nil }
      let start = offset + 4
      let end = Swift.min(start + length - 2, reader.bytes.count)
      offset = start + length - 2
      return start <= end ? Segment(marker: marker, payload: start..<end) : nil
    }
    return nil
  }
}

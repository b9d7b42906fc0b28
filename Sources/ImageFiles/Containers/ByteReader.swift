import SceneModel

/// Reads numbers from a file's bytes; nil for anything out of bounds.
package struct ByteReader: Sendable {
  /// Byte order.
  package enum Order: Sendable { case big, little }

  /// The content of the file.
  package let bytes: [UInt8]

  package init(_ bytes: [UInt8]) { self.bytes = bytes }

  /// The byte at an offset from the start.
  package func byte(_ offset: Int) -> Int? {
    bytes.indices.contains(offset) ? Int(bytes[offset]) : nil
  }

  /// An unsigned integer of 1…8 bytes.
  package func unsigned(_ offset: Int, bytes count: Int, _ order: Order) -> UInt64? {
    guard offset >= 0, count > 0, count <= 8, offset <= bytes.count - count else { return nil }
    let slice = bytes[offset..<offset + count]
    return order == .big
      ? slice.reduce(0) { $0 << 8 | UInt64($1) }
      : slice.reversed().reduce(0) { $0 << 8 | UInt64($1) }
  }

  /// An unsigned 16-bit integer.
  package func uint16(_ offset: Int, _ order: Order) -> Int? {
    unsigned(offset, bytes: 2, order).map { Int($0) }
  }

  /// Little-endian, as in WebP.
  package func uint24(_ offset: Int) -> Int? {
    unsigned(offset, bytes: 3, .little).map { Int($0) }
  }

  /// An unsigned 32-bit integer.
  package func uint32(_ offset: Int, _ order: Order) -> Int? {
    unsigned(offset, bytes: 4, order).map { Int($0) }
  }

  /// Whether the file starts with these bytes.
  package func hasPrefix(_ prefix: [UInt8]) -> Bool { bytes.starts(with: prefix) }

  /// Whether the file starts with this text in UTF-8.
  package func hasPrefix(_ prefix: String) -> Bool { bytes.starts(with: prefix.utf8) }

  /// Whether `text`, in ASCII, is at an offset.
  package func hasText(_ text: String, at offset: Int) -> Bool {
    self.text(at: offset, count: text.utf8.count) == text
  }

  /// ASCII text; nil if it is out of bounds or not ASCII.
  package func text(at offset: Int, count: Int) -> String? {
    guard offset >= 0, count >= 0, count <= bytes.count, offset <= bytes.count - count else {
      return nil
    }
    let slice = bytes[offset..<offset + count]
    return slice.allSatisfy { $0 < 0x80 } ? String(decoding: slice, as: UTF8.self) : nil
  }

  /// Whether the file starts as a JPEG, PNG or WebP file does.
  var isJPEG: Bool { hasPrefix([0xFF, 0xD8]) }
  var isPNG: Bool { hasPrefix([0x89, 0x50, 0x4E, 0x47]) }
  var isWebP: Bool { hasPrefix("RIFF") && hasText("WEBP", at: 8) }

  /// Whether the first kilobyte contains only printable characters and white space.
  var looksLikeText: Bool {
    !bytes.isEmpty
      && bytes.prefix(1024).allSatisfy { $0 >= 0x20 && $0 != 0x7F || (9...13).contains($0) }
  }
}

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

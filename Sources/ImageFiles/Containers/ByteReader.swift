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

/// An uncompressed zip archive with every entry's data aligned to 64 bytes (PKWARE, APPNOTE.TXT).
package struct StoredZip {
  private struct Entry {
    var name: [UInt8]
    var checksum: UInt32
    var size: UInt32
    var offset: UInt32
  }

  /// Bytes to which the content of files is aligned. Limit: of the USDZ format.
  private static let alignment = 64
  /// 1980-01-01 00:00. Limit: the zip epoch.
  private static let date: UInt16 = 1 << 5 | 1
  /// The version needed to extract: 1.0, for stored entries.
  private static let version: UInt16 = 10
  private static let localHeaderSignature: UInt32 = 0x0403_4B50
  private static let directoryEntrySignature: UInt32 = 0x0201_4B50
  private static let directoryEndSignature: UInt32 = 0x0605_4B50
  /// Sizes in bytes, without the name and without a comment. Limit: of the format.
  private static let (directoryEntrySize, directoryEndSize) = (46, 22)
  /// The ID of the extra field that pads entries; USD's own writer uses the same.
  private static let paddingFieldID: UInt16 = 0x1986
  /// ID and length of an extra field. Limit: of the format.
  private static let fieldHeaderSize = 4

  private var writer = ByteWriter()
  private var entries: [Entry] = []

  package init() {}

  /// Size of the archive in bytes, including the directory that `finish` appends.
  package var size: Int {
    writer.count
      + entries.reduce(Self.directoryEndSize) { $0 + Self.directoryEntrySize + $1.name.count }
  }

  /// Adds an entry. The archive must stay below 4 GiB: see `size`.
  package mutating func append(_ name: String, _ bytes: [UInt8]) {
    let name = Array(name.utf8)
    let entry = Entry(
      name: name, checksum: CRC32.checksum(bytes), size: UInt32(truncatingIfNeeded: bytes.count),
      offset: UInt32(truncatingIfNeeded: writer.count))
    entries.append(entry)
    writer.append(Self.localHeaderSignature)
    writer.append(Self.version)
    appendDescription(of: entry)
    // After the lengths of the name and of the extra field, and the name.
    let padding = Self.padding(at: writer.count + 4 + name.count)
    writer.append(UInt16(name.count))
    writer.append(UInt16(padding))
    writer.append(contentsOf: name)
    appendExtraField(length: padding)
    writer.append(contentsOf: bytes)
  }

  /// Appends the central directory and returns the archive.
  package mutating func finish() -> [UInt8] {
    let start = writer.count
    for entry in entries {
      writer.append(Self.directoryEntrySignature)
      writer.append(Self.version)
      writer.append(Self.version)
      appendDescription(of: entry)
      writer.append(UInt16(entry.name.count))
      for _ in 0..<4 { writer.append(UInt16(0)) }
      writer.append(UInt32(0))
      writer.append(entry.offset)
      writer.append(contentsOf: entry.name)
    }
    let length = writer.count - start
    writer.append(Self.directoryEndSignature)
    writer.append(UInt32(0))
    writer.append(UInt16(entries.count))
    writer.append(UInt16(entries.count))
    writer.append(UInt32(length))
    writer.append(UInt32(start))
    writer.append(UInt16(0))
    return writer.bytes
  }

  /// Flags, method, time and date, checksum and both sizes.
  private mutating func appendDescription(of entry: Entry) {
    writer.append(UInt16(0))
    writer.append(UInt16(0))
    writer.append(UInt16(0))
    writer.append(Self.date)
    writer.append(entry.checksum)
    writer.append(entry.size)
    writer.append(entry.size)
  }

  /// Length of an extra field at `offset` so that its end is aligned to 64 bytes: none, or at least
  /// the four bytes of its header.
  private static func padding(at offset: Int) -> Int {
    let distance = (alignment - offset % alignment) % alignment
    return distance == 0 || distance >= fieldHeaderSize ? distance : distance + alignment
  }

  private mutating func appendExtraField(length: Int) {
    guard length > 0 else { return }
    let payload = length - Self.fieldHeaderSize
    writer.append(Self.paddingFieldID)
    writer.append(UInt16(payload))
    writer.append(contentsOf: [UInt8](repeating: 0, count: payload))
  }
}

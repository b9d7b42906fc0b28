/// The entries of an untrusted zip archive without compression (PKWARE, APPNOTE.TXT).
struct ZipArchive {
  struct Entry {
    var name: String
    /// 0 for an entry that is stored as it is.
    var method: Int
    var size: Int
    /// The position of the local header.
    var offset: Int
  }

  private static let directoryEnd: [UInt8] = [0x50, 0x4B, 5, 6]
  private static let (localHeader, directoryEntry): (UInt64, UInt64) = (0x0403_4B50, 0x0201_4B50)
  /// The size of the end of the directory without a comment, and the longest comment. Limit: of the
  /// format, whose lengths have 16 bits.
  private static let (endSize, maximumComment) = (22, 65_535)

  let bytes: [UInt8]
  private(set) var entries: [Entry] = []
  private var indices: [String: Int] = [:]

  /// Throws a `FormatFault`, or `ByteCursor.Truncated`.
  init(_ bytes: [UInt8]) throws {
    self.bytes = bytes
    var cursor = ByteCursor(bytes, from: try Self.findEnd(bytes))
    _ = try cursor.take(10)
    let count = Int(try cursor.unsigned(2))
    _ = try cursor.take(4)
    try cursor.seek(to: Int(try cursor.unsigned(4)))
    for _ in 0..<count {
      let entry = try Self.entry(&cursor)
      indices[entry.name] = indices[entry.name] ?? entries.count
      entries.append(entry)
    }
  }

  private static func findEnd(_ bytes: [UInt8]) throws -> Int {
    let first = max(0, bytes.count - endSize - maximumComment)
    for start in stride(from: bytes.count - endSize, through: first, by: -1)
    where bytes[start] == directoryEnd[0] && bytes[start...].starts(with: directoryEnd) {
      return start
    }
    throw FormatFault("it is not a complete zip archive")
  }

  private static func entry(_ cursor: inout ByteCursor) throws -> Entry {
    guard try cursor.unsigned(4) == directoryEntry else {
      throw FormatFault("the directory of the archive is damaged")
    }
    _ = try cursor.take(6)
    let method = Int(try cursor.unsigned(2))
    _ = try cursor.take(8)
    let compressedSize = Int(try cursor.unsigned(4))
    let size = Int(try cursor.unsigned(4))
    let (name, extra) = (Int(try cursor.unsigned(2)), Int(try cursor.unsigned(2)))
    let comment = Int(try cursor.unsigned(2))
    _ = try cursor.take(8)
    let offset = Int(try cursor.unsigned(4))
    let text = String(decoding: try cursor.take(name), as: UTF8.self)
    _ = try cursor.take(extra + comment)
    return Entry(
      name: text, method: method, size: method == 0 ? compressedSize : size, offset: offset)
  }

  /// The content of the entry of a name; nil without one. Throws a `FormatFault`, an
  /// `UnsupportedFeature`, or `ByteCursor.Truncated`.
  func contents(of name: String) throws -> [UInt8]? {
    guard let index = indices[name] else { return nil }
    let entry = entries[index]
    guard entry.method == 0 else {
      throw UnsupportedFeature(
        reason: "\(entry.name) in it is compressed, which USDZ does not allow",
        remedy: "Package it with usdzip of OpenUSD.")
    }
    var cursor = ByteCursor(bytes, from: try dataOffset(of: entry))
    return Array(try cursor.take(entry.size))
  }

  /// The position of an entry's data. Throws a `FormatFault` or `ByteCursor.Truncated`.
  func dataOffset(of entry: Entry) throws -> Int {
    var cursor = ByteCursor(bytes)
    try cursor.seek(to: entry.offset)
    guard try cursor.unsigned(4) == Self.localHeader else {
      throw FormatFault("\(entry.name) in it is damaged")
    }
    _ = try cursor.take(22)
    let (nameSize, extra) = (Int(try cursor.unsigned(2)), Int(try cursor.unsigned(2)))
    _ = try cursor.take(nameSize + extra)
    return cursor.offset
  }
}

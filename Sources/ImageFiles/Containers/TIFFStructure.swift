import SceneModel

/// The directories of a TIFF file or of EXIF data; classic and BigTIFF.
package struct TIFFStructure: Sendable {
  /// One field of a directory.
  package struct Entry: Sendable {
    package var tag: Int
    /// TIFF field type, 1…13.
    package var type: Int
    /// Number of values.
    package var count: Int
    /// Offset of its values in the file.
    package var valueOffset: Int
  }

  /// Sizes in bytes of the field types 1…13.
  private static let sizes = [0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4]
  /// The rest of a malicious directory is not read. Chosen: more fields than any camera writes.
  private static let maximumEntries = 1024
  /// Bytes before the directory in a maker note of Apple's phones. Limit: of the format.
  private static let appleHeaderSize = 14

  private let reader: ByteReader
  private let order: ByteReader.Order
  private let isBig: Bool
  /// Start of the structure in the file; its offsets are relative to it.
  private let origin: Int
  /// Offset of the first directory.
  package let firstDirectory: Int

  /// Nil without a TIFF header at `origin`.
  package init?(_ reader: ByteReader, at origin: Int = 0) {
    switch reader.text(at: origin, count: 2) {
    case "II": order = .little
    case "MM": order = .big
    default: return nil
    }
    self.reader = reader
    self.origin = origin
    let version = reader.uint16(origin + 2, order)
    isBig = version == 43
    guard version == 42 || version == 43,
      let directory = reader.unsigned(
        origin + (version == 43 ? 8 : 4), bytes: version == 43 ? 8 : 4, order),
      directory <= UInt64(Int32.max)
    else { return nil }
    firstDirectory = Int(directory)
  }

  /// The fields of the directory at an offset; empty if there is none.
  package func entries(ofDirectoryAt directory: Int) -> [Entry] {
    let start = origin + directory
    let (countBytes, entryBytes, inlineBytes) = isBig ? (8, 20, 8) : (2, 12, 4)
    guard directory > 0, directory <= Int(Int32.max),
      let count = reader.unsigned(start, bytes: countBytes, order)
    else { return [] }
    return (0..<Int(min(count, UInt64(Self.maximumEntries)))).compactMap { index in
      let offset = start + countBytes + index * entryBytes
      guard let tag = reader.uint16(offset, order), let type = reader.uint16(offset + 2, order),
        Self.sizes.indices.contains(type), type > 0,
        let values = reader.unsigned(offset + 4, bytes: inlineBytes, order),
        values <= UInt64(Int32.max)
      else { return nil }
      let inline = offset + 4 + inlineBytes
      if Int(values) * Self.sizes[type] <= inlineBytes {
        return Entry(tag: tag, type: type, count: Int(values), valueOffset: inline)
      }
      guard let elsewhere = reader.unsigned(inline, bytes: inlineBytes, order),
        elsewhere <= UInt64(Int32.max)
      else { return nil }
      return Entry(
        tag: tag, type: type, count: Int(values), valueOffset: origin + Int(elsewhere))
    }
  }

  /// Finds the structure with the EXIF data of an image file.
  package init?(exifOf reader: ByteReader) {
    if reader.isJPEG {
      let found = JPEGSegments(reader).lazy
        .filter { $0.marker == 0xE1 && reader.hasText("Exif\0", at: $0.payload.lowerBound) }
        .compactMap { TIFFStructure(reader, at: $0.payload.lowerBound + 6) }.first
      guard let found else { return nil }
      self = found
    } else if reader.isPNG {
      self.init(reader, FileChunks(png: reader).first { $0.name == "eXIf" })
    } else if reader.isWebP {
      self.init(reader, FileChunks(webP: reader).first { $0.name == "EXIF" })
    } else if HEIFFile.Kind(reader) != nil {
      guard let exif = HEIFFile.exif(reader.bytes) else { return nil }
      self.init(ByteReader(exif))
    } else {
      self.init(reader)
    }
  }

  /// The directory in a maker note of Apple's phones: it follows a name, a version and the byte
  /// order, and its offsets are relative to the note.
  init?(appleMakerNote note: Entry, in tiff: TIFFStructure) {
    reader = tiff.reader
    origin = note.valueOffset
    guard note.count > Self.appleHeaderSize, reader.hasText("Apple iOS\0", at: origin) else {
      return nil
    }
    switch reader.text(at: origin + Self.appleHeaderSize - 2, count: 2) {
    case "II": order = .little
    case "MM": order = .big
    default: return nil
    }
    isBig = false
    firstDirectory = Self.appleHeaderSize
  }

  /// Skips the "Exif" identifier of JPEG, which some programs also write to other formats.
  private init?(_ reader: ByteReader, _ chunk: FileChunks.Chunk?) {
    guard let start = chunk?.data.lowerBound else { return nil }
    self.init(reader, at: reader.hasText("Exif\0", at: start) ? start + 6 : start)
  }

  /// The unsigned integer value of a directory's field: a number, or the offset of another
  /// directory.
  package func integer(of tag: Int, in directory: Int) -> Int? {
    entries(ofDirectoryAt: directory).first { $0.tag == tag }.flatMap { integer($0) }
  }

  /// The bytes of a field of type BYTE or UNDEFINED.
  package func bytes(_ entry: Entry) -> [UInt8]? {
    guard entry.type == 1 || entry.type == 7, entry.valueOffset >= 0, entry.count > 0,
      entry.valueOffset <= reader.bytes.count - entry.count
    else { return nil }
    return Array(reader.bytes[entry.valueOffset..<entry.valueOffset + entry.count])
  }

  /// Value `index` of an unsigned integer field.
  package func integer(_ entry: Entry, _ index: Int = 0) -> Int? {
    let size = [1: 1, 3: 2, 4: 4, 13: 4][entry.type]
    guard let size, index >= 0, index < entry.count else { return nil }
    return reader.unsigned(entry.valueOffset + index * size, bytes: size, order).map { Int($0) }
  }

  /// Value `index` of a numeric field; nil for a rational with a zero denominator.
  package func number(_ entry: Entry, _ index: Int = 0) -> Double? {
    guard index >= 0, index < entry.count else { return nil }
    guard entry.type == 5 || entry.type == 10 else {
      return integer(entry, index).map { Double($0) }
    }
    let offset = entry.valueOffset + 8 * index
    guard let numerator = reader.uint32(offset, order),
      let denominator = reader.uint32(offset + 4, order), denominator != 0
    else { return nil }
    guard entry.type == 10 else { return Double(numerator) / Double(denominator) }
    return Double(Int32(truncatingIfNeeded: numerator))
      / Double(Int32(truncatingIfNeeded: denominator))
  }

  /// An ASCII field, trimmed of zeros and spaces; nil if nothing is left.
  package func text(_ entry: Entry) -> String? {
    guard entry.type == 2, entry.count > 0, entry.count <= 4096,
      entry.valueOffset >= 0, entry.valueOffset < reader.bytes.count
    else { return nil }
    let end = min(entry.valueOffset + entry.count, reader.bytes.count)
    let content = reader.bytes[entry.valueOffset..<end].prefix { $0 != 0 }
    let printable = content.map { (0x20..<0x7F).contains($0) ? $0 : UInt8(ascii: "?") }
    let trimmed = String(decoding: printable, as: UTF8.self)
      .drop { $0 == " " }.reversed().drop { $0 == " " }.reversed()
    return trimmed.isEmpty ? nil : String(trimmed)
  }
}

/// The sections of an untrusted crate file.
struct CrateFile {
  /// The first version with compressed tables, of 2016.
  private static let oldestVersion = 4
  private static let signature = Array("PXR-USDC".utf8)

  let bytes: [UInt8]
  /// Minor version; the major one is 0.
  let version: Int
  private var sections: [String: Range<Int>] = [:]

  /// Throws a `FormatFault`, an `UnsupportedFeature`, or `ByteCursor.Truncated`.
  init(_ bytes: [UInt8]) throws {
    self.bytes = bytes
    guard bytes.starts(with: Self.signature) else {
      throw FormatFault("it does not begin with PXR-USDC")
    }
    var header = ByteCursor(bytes, from: Self.signature.count)
    let major = try header.unsigned(1)
    version = Int(try header.unsigned(1))
    guard major == 0, version >= Self.oldestVersion else {
      throw UnsupportedFeature(
        reason: "it has version \(major).\(version) of the crate format",
        remedy: "Convert it with usdcat of OpenUSD.")
    }
    try header.seek(to: 16)
    let contents = try header.count()
    try header.seek(to: contents)
    // The format defines six sections; 64 is chosen.
    for _ in 0..<min(try header.count(), 64) {
      let name = String(decoding: try header.take(16).prefix { $0 != 0 }, as: UTF8.self)
      let (start, size) = (try header.count(), try header.count())
      guard start <= bytes.count, size <= bytes.count - start else {
        throw FormatFault("its section \(name) ends after the file")
      }
      sections[name] = start..<start + size
    }
  }

  /// The bytes of a section; throws a `FormatFault` without it.
  func section(_ name: String) throws -> ByteCursor {
    guard let range = sections[name] else { throw FormatFault("it has no section \(name)") }
    return ByteCursor(Array(bytes[range]))
  }
}

import Foundation

/// The rules for the archive of a USDZ package.
struct PackageRules {
  /// Data of files begins at multiples of this. Limit: of USDZ (specification, "Layout").
  private static let alignment = 64
  /// What AR Quick Look reads (OpenUSD, `ARKitFileExtensionChecker`).
  private static let extensions: Set = [
    "usda", "usdc", "usd", "usdz", "png", "jpg", "jpeg", "exr",
  ]

  private(set) var findings: [String] = []

  /// Throws `ByteCursor.Truncated` for a damaged archive.
  init(_ archive: ZipArchive) throws {
    if let first = archive.entries.first, !first.name.lowercased().hasSuffix(".usdc") {
      findings.append("the first file is \(first.name), ARKit wants a .usdc")
    }
    for entry in archive.entries {
      if entry.method != 0 { findings.append("\(entry.name) is compressed") }
      let start = try archive.dataOffset(of: entry)
      if start % Self.alignment != 0 {
        findings.append("\(entry.name) starts at \(start), not at a multiple of \(Self.alignment)")
      }
      let kind = (entry.name as NSString).pathExtension.lowercased()
      if !Self.extensions.contains(kind) {
        findings.append("\(entry.name) is of a kind that ARKit does not read")
      }
    }
  }
}

extension USDLayer {
  /// The extensions of files with a layer.
  static let fileExtensions = ["usdc", "usda", "usd"]

  /// A layer in either file format, which its first bytes indicate. Throws a `FormatFault`, an
  /// `UnsupportedFeature`, or `ByteCursor.Truncated`.
  init(_ bytes: [UInt8], budget: MemoryBudget) throws {
    self =
      bytes.starts(with: Array("#usda".utf8))
      ? try USDAText.decode(bytes) : try USDCrate.decode(bytes, budget: budget)
  }

  /// The value of a metadata field.
  func metadata(_ name: String) -> USDValue? { metadata.first { $0.name == name }?.value }
}

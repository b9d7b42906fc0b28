import ImageFiles

extension Check {
  /// Whether photos can be decoded; `failures` are the formats that could not, with the reasons.
  static func imageFormats(failures: [ImageHeader.Format: String]) -> Check {
    let formats = SampleImage.all.map(\.format)
    let failed = formats.filter { failures[$0] != nil }
    let decoded = formats.filter { failures[$0] == nil }.map(\.rawValue).joined(separator: ", ")
    guard !failed.isEmpty else {
      return Check(.imageFormats, .ok, "\(decoded) were decoded.")
    }
    let reasons = failed.map { "\($0.rawValue) can't be decoded (\(failures[$0] ?? ""))" }
      .joined(separator: ", ")
    // Without these, most folders of photos can't be used.
    let isBasic = failed.contains(.jpeg) || failed.contains(.png)
    return Check(
      .imageFormats, isBasic ? .problem : .note,
      reasons + (decoded.isEmpty ? "." : "; \(decoded) were decoded."),
      remedy: failed.allSatisfy { [.heic, .avif].contains($0) }
        ? "Install the decoders of libheif (Debian 13: libheif-plugin-libde265 and "
          + "libheif-plugin-aomdec), or convert such photos to JPEG."
        : "Reinstall the program; if you compiled it, run scripts/setup."
    )
  }
}

extension SampleImage {
  /// The formats that can't be decoded, with the reasons.
  static func failures() -> [ImageHeader.Format: String] {
    Dictionary(
      uniqueKeysWithValues: all.compactMap { sample in
        sample.failure().map { (sample.format, $0) }
      })
  }
}

import ImageFiles

extension Check {
  /// Whether photos can be decoded; `failures` are the formats that could not, with the reasons;
  /// `leftOut` are those that the program was built without.
  static func imageFormats(
    failures: [ImageHeader.Format: String], leftOut: Set<ImageHeader.Format> = []
  ) -> Check {
    let formats = SampleImage.all.map(\.format).filter { !leftOut.contains($0) }
    let failed = formats.filter { failures[$0] != nil }
    let decoded = formats.filter { failures[$0] == nil }.map(\.rawValue).joined(separator: ", ")
    guard !failed.isEmpty else {
      let others = SampleImage.all.map(\.format).filter(leftOut.contains).map(\.rawValue)
      let absence =
        others.isEmpty
        ? "" : " This program was built without \(others.joined(separator: " and "))."
      return Check(.imageFormats, .ok, "\(decoded) were decoded." + absence)
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
  /// The formats that the program was built without.
  static func leftOut() -> Set<ImageHeader.Format> {
    Set(all.filter(\.isLeftOut).map(\.format))
  }

  /// The formats that can't be decoded although they should be, with the reasons.
  static func failures() -> [ImageHeader.Format: String] {
    Dictionary(
      uniqueKeysWithValues: all.filter { !$0.isLeftOut }.compactMap { sample in
        sample.failure().map { (sample.format, $0) }
      })
  }
}

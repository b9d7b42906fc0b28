import Formats

/// Where a model is written: the URL determines the kind of output.
enum OutputLocation: Hashable {
  case file(URL)
  case folder(URL)

  /// Interprets a URL as Apple's session does: a file by the suffix `usdz`, or else a folder. The
  /// suffixes of `additionalFormats` are treated like `usdz`. Nil if nothing can be written there.
  init?(_ url: URL, additionalFormats: Set<ModelFormat> = []) {
    guard Self.fault(of: url, additionalFormats: additionalFormats) == nil else { return nil }
    self = Self.namesFile(url, additionalFormats) ? .file(url) : .folder(url)
  }

  /// Why nothing can be written to a URL, in a sentence; nil if it can.
  static func fault(of url: URL, additionalFormats: Set<ModelFormat> = []) -> String? {
    guard url.isFileURL else { return "\(url.absoluteString) is not on a disk of this machine." }
    guard namesFile(url, additionalFormats) else {
      return url.hasDirectoryPath
        ? folderFault(of: url) : "\(url.path) names neither a .usdz file nor a folder."
    }
    if url.isExistingFolder { return "\(url.path) is a folder." }
    let parent = url.deletingLastPathComponent()
    guard parent.isExistingFolder else { return "The folder \(parent.path) does not exist." }
    return isWritable(parent) ? nil : "The folder \(parent.path) can't be written to."
  }

  private static func namesFile(_ url: URL, _ additionalFormats: Set<ModelFormat>) -> Bool {
    switch ModelFormat(of: url) {
    case .usdz: true
    case .folder: false
    case let format: additionalFormats.contains(format)
    }
  }

  /// A folder that does not exist is created, which needs a writable nearest existing ancestor.
  private static func folderFault(of url: URL) -> String? {
    var existing = url.standardizedFileURL
    while !FileManager.default.fileExists(atPath: existing.path), existing.path != "/" {
      existing = existing.deletingLastPathComponent()
    }
    guard existing.isExistingFolder else { return "\(existing.path) is a file and not a folder." }
    return isWritable(existing) ? nil : "The folder \(existing.path) can't be written to."
  }

  /// Tests by writing a file: permissions alone don't reveal read-only and special file systems.
  private static func isWritable(_ folder: URL) -> Bool {
    guard FileManager.default.isWritableFile(atPath: folder.path) else { return false }
    let probe = folder.appendingPathComponent(".\(UUID().uuidString)")
    defer { try? FileManager.default.removeItem(at: probe) }
    return FileManager.default.createFile(atPath: probe.path, contents: nil)
  }
}

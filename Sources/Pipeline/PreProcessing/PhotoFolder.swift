import Foundation

/// The files of an input folder.
package enum PhotoFolder {
  /// Names of mask folders that are looked up inside the folder of photos.
  package static let maskFolderNames = ["masks", "mask", ".mask"]

  /// Returns the regular files that are not hidden, without those of subfolders, in natural,
  /// case-insensitive order (`IMG_2` before `IMG_10`), so that sequences are in the order of
  /// capture. The index in the result is a file's sample ID. Throws
  /// `PipelineError.unreadableFolder`.
  package static func files(in folder: URL) throws -> [URL] {
    func unreadable(_ reason: String) -> PipelineError {
      .unreadableFolder(path: folder.path, reason: reason)
    }
    var isDirectory: ObjCBool = false
    guard FileManager.default.fileExists(atPath: folder.path, isDirectory: &isDirectory) else {
      throw unreadable("it does not exist")
    }
    guard isDirectory.boolValue else { throw unreadable("it is not a folder") }
    let contents: [URL]
    do {
      contents = try FileManager.default.contentsOfDirectory(
        at: folder, includingPropertiesForKeys: [.isRegularFileKey])
    } catch {
      throw unreadable("access is denied")
    }
    return
      contents
      .filter { url in
        let values = try? url.resolvingSymlinksInPath().resourceValues(
          forKeys: [.isRegularFileKey])
        return values?.isRegularFile == true && !url.lastPathComponent.hasPrefix(".")
      }
      .map { (url: $0, key: NaturalSortKey($0.lastPathComponent)) }
      .sorted { $0.key < $1.key }
      .map(\.url)
  }
}

/// Compares runs of digits as numbers; names that differ only in case or leading zeros compare byte
/// by byte.
struct NaturalSortKey: Comparable {
  private enum Part: Equatable {
    case number(digits: [UInt8])
    case byte(UInt8)
  }

  private let parts: [Part]
  private let name: [UInt8]

  init(_ name: String) {
    self.name = Array(name.utf8)
    var parts: [Part] = []
    var digits: [UInt8]?
    for byte in name.lowercased().utf8 {
      if (UInt8(ascii: "0")...UInt8(ascii: "9")).contains(byte) {
        digits = (digits == [UInt8(ascii: "0")] ? [] : digits ?? []) + [byte]
      } else {
        if let digits { parts.append(.number(digits: digits)) }
        digits = nil
        parts.append(.byte(byte))
      }
    }
    if let digits { parts.append(.number(digits: digits)) }
    self.parts = parts
  }

  static func < (a: Self, b: Self) -> Bool {
    for (first, second) in zip(a.parts, b.parts) where first != second {
      switch (first, second) {
      case (.number(let x), .number(let y)):
        return x.count == y.count ? x.lexicographicallyPrecedes(y) : x.count < y.count
      case (.byte(let x), .byte(let y)): return x < y
      case (.number, .byte(let y)): return UInt8(ascii: "0") < y
      case (.byte(let x), .number): return x < UInt8(ascii: "0")
      }
    }
    if a.parts.count != b.parts.count { return a.parts.count < b.parts.count }
    return a.name.lexicographicallyPrecedes(b.name)
  }
}

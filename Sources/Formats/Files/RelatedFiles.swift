import Foundation

/// The files that a model refers to by paths relative to its folder.
final class RelatedFiles {
  private let folder: URL
  /// Bytes that may still be read: a file can refer to others any number of times. Chosen.
  private var rest = 1 << 32

  init(folder: URL) { self.folder = folder }

  /// The bytes of the regular file at `path`; nil without one.
  ///
  /// Many files have the paths of the computer on which they were written: if there is no file at
  /// such a path, one of its name in the model's folder is used.
  func contents(of path: String) -> [UInt8]? {
    let path = path.replacingOccurrences(of: "\\", with: "/")
    guard !path.isEmpty, !path.utf8.contains(0) else { return nil }
    let name = path.split(separator: "/").last.map(String.init) ?? path
    return regularFile(path) ?? regularFile(name)
  }

  private func regularFile(_ path: String) -> [UInt8]? {
    let url = path.hasPrefix("/") ? URL(fileURLWithPath: path) : folder.appendingPathComponent(path)
    // Reading a pipe or a device may never end.
    guard
      let values = try? url.resolvingSymlinksInPath().resourceValues(
        forKeys: [.isRegularFileKey, .fileSizeKey]),
      values.isRegularFile == true, let size = values.fileSize, size <= rest
    else { return nil }
    rest -= size
    return try? Formats.contents(of: url)
  }
}

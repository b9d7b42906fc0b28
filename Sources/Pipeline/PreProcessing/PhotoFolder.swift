import Foundation

/// The files of an input folder.
package enum PhotoFolder {
  /// Names of mask folders that are looked up inside the folder of photos.
  package static let maskFolderNames = ["masks", "mask", ".mask"]

  /// Returns the regular files of a folder, or of one that it is a symbolic link to, which are not
  /// hidden, without those of subfolders, in natural, case-insensitive order (`IMG_2` before
  /// `IMG_10`), so that sequences are in the order of capture. The index in the result is a file's
  /// sample ID. Throws `PipelineError.unreadableFolder`.
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
      // `contentsOfDirectory(at:)` does not follow symbolic links.
      contents = try FileManager.default.contentsOfDirectory(atPath: folder.path)
        .map { folder.appendingPathComponent($0) }
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

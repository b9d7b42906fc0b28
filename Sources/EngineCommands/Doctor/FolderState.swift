import Foundation
import Pipeline

/// A folder to write files into.
struct FolderState: Equatable {
  var path: String
  var isWritable: Bool
  /// Bytes that can be written; nil if unknown.
  var freeBytes: Int?
  /// Whether files in it take memory instead of disk space.
  var isInMemory = false

  /// The folder for temporary files. Creates a folder in it, and removes it.
  static var temporary: FolderState {
    let url = ScratchFolder.parent
    return FolderState(path: url.path, isWritable: (try? ScratchFolder(in: url)) != nil)
  }

  /// The folder in which the program was started.
  static var current: FolderState {
    let path = FileManager.default.currentDirectoryPath
    return FolderState(path: path, isWritable: FileManager.default.isWritableFile(atPath: path))
  }

  /// Measures the space in the folder `path`.
  private init(path: String, isWritable: Bool) {
    let system = try? FileManager.default.attributesOfFileSystem(forPath: path)
    let mounts = try? String(contentsOfFile: "/proc/self/mounts", encoding: .utf8)
    let type = Self.fileSystem(
      of: URL(fileURLWithPath: path).resolvingSymlinksInPath().path, mounts: mounts ?? "")
    self.init(
      path: path, isWritable: isWritable,
      freeBytes: (system?[.systemFreeSize] as? NSNumber)?.intValue,
      isInMemory: type == "tmpfs" || type == "ramfs")
  }

  init(path: String, isWritable: Bool, freeBytes: Int?, isInMemory: Bool = false) {
    (self.path, self.isWritable) = (path, isWritable)
    (self.freeBytes, self.isInMemory) = (freeBytes, isInMemory)
  }

  /// The type of the file system that holds `path`, from the content of `/proc/self/mounts`: that
  /// of the innermost mount point, the last one if several share it. Nil if there is none.
  static func fileSystem(of path: String, mounts: String) -> String? {
    var innermost: (point: String, type: String)?
    for line in mounts.split(separator: "\n") {
      let fields = line.split(separator: " ").map(String.init)
      guard fields.count > 2 else { continue }
      let (point, type) = (fields[1].replacingOccurrences(of: "\\040", with: " "), fields[2])
      let holdsPath = point == "/" || path == point || path.hasPrefix(point + "/")
      if holdsPath, point.count >= innermost?.point.count ?? 0 { innermost = (point, type) }
    }
    return innermost?.type
  }
}

import Formats
import Foundation
import Synchronization

/// A folder of intermediate files, removed when it is deallocated, at the latest when the process
/// exits: `exit` doesn't deallocate what is still in use.
package final class ScratchFolder: Sendable {
  package let url: URL

  /// Folders that exist, by path.
  private static let existing = Mutex<Set<String>>([])
  /// Registers the removal at exit, once.
  private static let removalAtExit: Void = {
    atexit { ScratchFolder.removeAll() }
  }()

  /// Creates a folder with a unique name in `parent`; throws `OutputError.notWritable`.
  package init(in parent: URL = parent) throws {
    url = parent.appendingPathComponent("photogrammetry-\(UUID().uuidString)", isDirectory: true)
    _ = Self.removalAtExit
    do {
      try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
    } catch {
      throw OutputError.notWritable(path: parent.path)
    }
    Self.existing.withLock { _ = $0.insert(url.path) }
  }

  deinit {
    // Locked during the removal: the process must not exit in the middle of it.
    Self.existing.withLock { paths in
      if paths.remove(url.path) != nil { try? FileManager.default.removeItem(at: url) }
    }
  }

  /// Removes all temporary folders of the process.
  private static func removeAll() {
    existing.withLock { paths in
      paths.forEach { try? FileManager.default.removeItem(atPath: $0) }
      paths.removeAll()
    }
  }

  /// Where temporary folders are created: `TMPDIR` if set, else `/var/tmp`, the folder for large
  /// temporary files: `/tmp` is often in memory.
  package static var parent: URL {
    let large = "/var/tmp"
    let isChosen = ProcessInfo.processInfo.environment["TMPDIR"]?.isEmpty == false
    return !isChosen && FileManager.default.isWritableFile(atPath: large)
      ? URL(fileURLWithPath: large, isDirectory: true) : FileManager.default.temporaryDirectory
  }
}

import Foundation

/// Prevents two runs from using a checkpoint directory at the same time, until it is deallocated.
///
/// An advisory lock (`flock`) on the file `.lock` in the directory, which is released when the
/// process ends in any way. On file systems without locks it has no effect.
package final class DirectoryLock {
  private let descriptor: Int32

  /// Acquires the lock, exclusively or shared. Creates the directory if it is missing. Throws
  /// `CheckpointError`.
  package init(_ directory: URL, isShared: Bool) throws {
    do {
      try FileManager.default.createDirectory(at: directory, withIntermediateDirectories: true)
    } catch {
      throw CheckpointError.notWritable(directory: directory.path)
    }
    let path = directory.appendingPathComponent(".lock").path
    let file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0o644)
    guard file >= 0 else { throw CheckpointError.notWritable(directory: directory.path) }
    guard Self.lock(file, isShared: isShared) else {
      close(file)
      throw CheckpointError.inUse(directory: directory.path)
    }
    // Assigned last: a fully initialized object closes it, even if its initializer throws.
    descriptor = file
  }

  /// Returns false if another process holds the lock.
  private static func lock(_ file: Int32, isShared: Bool) -> Bool {
    while flock(file, (isShared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0 {
      if errno != EINTR { return errno != EWOULDBLOCK }
    }
    return true
  }

  deinit { close(descriptor) }
}

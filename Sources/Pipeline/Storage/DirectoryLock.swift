import Foundation

/// Keeps two runs from using one checkpoint directory at once, until it goes away.
///
/// An advisory lock (`flock`) on the file `.lock` in the directory: it ends with the process, however
/// that ends. Where the file system knows no locks there is none.
package final class DirectoryLock {
  private let descriptor: Int32

  /// Takes the lock, alone or together with others who share it. Makes the directory where it is
  /// missing. Throws `CheckpointError`.
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
    // Not before: an object that is complete closes it, also when its initialiser throws.
    descriptor = file
  }

  /// False where another one has the lock.
  private static func lock(_ file: Int32, isShared: Bool) -> Bool {
    while flock(file, (isShared ? LOCK_SH : LOCK_EX) | LOCK_NB) != 0 {
      if errno != EINTR { return errno != EWOULDBLOCK }
    }
    return true
  }

  deinit { close(descriptor) }
}

/// Why a checkpoint directory can't be used: a sentence and a remedy.
package enum CheckpointError: LocalizedError, Equatable, Sendable {
  case inUse(directory: String)
  case notWritable(directory: String)

  package var errorDescription: String? {
    switch self {
    case .inUse(let directory): "Another run is using the checkpoint directory \(directory)."
    case .notWritable(let directory): "The checkpoint directory \(directory) can't be written to."
    }
  }

  package var recoverySuggestion: String? {
    switch self {
    case .inUse: "Wait until it ends, or name another directory."
    case .notWritable: "Name a directory that you may write to, or change its permissions."
    }
  }
}

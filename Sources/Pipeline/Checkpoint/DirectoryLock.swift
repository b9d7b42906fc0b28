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
    let file = directory.appendingPathComponent(".lock").path
    descriptor = open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0o644)
    guard descriptor >= 0 else { throw CheckpointError.notWritable(directory: directory.path) }
    let wish = (isShared ? LOCK_SH : LOCK_EX) | LOCK_NB
    while flock(descriptor, wish) != 0 {
      if errno == EINTR { continue }
      guard errno == EWOULDBLOCK else { return }
      close(descriptor)
      throw CheckpointError.inUse(directory: directory.path)
    }
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

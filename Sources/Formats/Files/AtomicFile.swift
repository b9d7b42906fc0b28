import Foundation

/// Files that appear complete or not at all: written under a temporary name in the same folder,
/// then renamed.
package enum AtomicFile {
  /// Writes `bytes`, replacing an existing file. Throws `OutputError`.
  package static func write(_ bytes: [UInt8], to url: URL) throws {
    try bytes.withUnsafeBytes { try write([$0], to: url) }
  }

  /// Writes `data`, replacing an existing file. Throws `OutputError`.
  package static func write(_ data: Data, to url: URL) throws {
    try write(to: url) { try data.write(to: $0) }
  }

  /// Writes the concatenated parts, replacing an existing file. Throws `OutputError`.
  package static func write(_ parts: [UnsafeRawBufferPointer], to url: URL) throws {
    try write(to: url) { append in try parts.forEach(append) }
  }

  /// Writes what `body` appends, replacing an existing file. Throws `OutputError`.
  static func write(
    to url: URL, _ body: (_ append: (UnsafeRawBufferPointer) throws -> Void) throws -> Void
  ) throws {
    try write(to: url) { temporary in
      let descriptor = open(temporary.path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0o666)
      guard descriptor >= 0 else { throw lastError }
      do {
        try body { try append($0, to: descriptor) }
      } catch {
        close(descriptor)
        throw error
      }
      // Some file systems report a full disk only here.
      guard close(descriptor) == 0 else { throw lastError }
    }
  }

  /// Calls `body` with a temporary name for the file, and renames the result.
  private static func write(to url: URL, _ body: (URL) throws -> Void) throws {
    try checkParent(of: url)
    if url.isExistingFolder { throw OutputError.isAFolder(path: url.path) }
    let temporary = temporaryURL(for: url)
    do {
      try body(temporary)
      try rename(temporary, to: url)
    } catch {
      try? FileManager.default.removeItem(at: temporary)
      throw outputError(error, path: url.path)
    }
  }

  /// Writes all bytes of a part, resuming after interrupts.
  private static func append(_ part: UnsafeRawBufferPointer, to descriptor: Int32) throws {
    var rest = part[...]
    while !rest.isEmpty {
      let count = Foundation.write(
        descriptor, UnsafeRawBufferPointer(rebasing: rest).baseAddress, rest.count)
      if count < 0, errno == EINTR { continue }
      guard count > 0 else { throw lastError }
      rest = rest.dropFirst(count)
    }
  }

  /// The current `errno`.
  private static var lastError: POSIXError { POSIXError(POSIXErrorCode(rawValue: errno) ?? .EIO) }

  /// Throws an `OutputError` unless the parent folder of `url` exists and is writable.
  package static func checkParent(of url: URL) throws {
    let parent = url.absoluteURL.deletingLastPathComponent()
    guard FileManager.default.fileExists(atPath: parent.path) else {
      throw OutputError.missingFolder(path: url.path, folder: parent.path)
    }
    guard parent.isExistingFolder else { throw OutputError.notAFolder(path: parent.path) }
    guard FileManager.default.isWritableFile(atPath: parent.path) else {
      throw OutputError.notWritable(path: url.path)
    }
  }

  /// A unique name in the same folder, with a limited length.
  static func temporaryURL(for url: URL) -> URL {
    let start = temporaryPrefix(of: url.lastPathComponent)
    return url.absoluteURL.deletingLastPathComponent()
      .appendingPathComponent(start + UUID().uuidString + temporarySuffix)
  }

  static let temporarySuffix = ".partial"

  /// The start of the temporary names for a file.
  static func temporaryPrefix(of name: String) -> String {
    var name = name
    while name.utf8.count > 64 { name.removeLast() }
    return ".\(name)."
  }

  /// Renames a file, replacing an existing one.
  static func rename(_ source: URL, to destination: URL) throws {
    guard Foundation.rename(source.path, destination.path) == 0 else {
      throw lastError
    }
  }

  /// Converts a system error to an `OutputError`.
  static func outputError(_ error: any Error, path: String) -> any Error {
    if error is OutputError { return error }
    if let code = (error as? POSIXError)?.code ?? underlyingCode(of: error) {
      switch code {
      case .ENOSPC, .EDQUOT: return OutputError.diskFull(path: path)
      case .EACCES, .EPERM, .EROFS: return OutputError.notWritable(path: path)
      case .EISDIR: return OutputError.isAFolder(path: path)
      case .ENOTDIR: return OutputError.notAFolder(path: path)
      default: break
      }
    }
    switch (error as? CocoaError)?.code {
    case .fileWriteOutOfSpace: return OutputError.diskFull(path: path)
    case .fileWriteNoPermission, .fileWriteVolumeReadOnly:
      return OutputError.notWritable(path: path)
    default: return OutputError.failed(path: path, reason: error.localizedDescription)
    }
  }

  private static func underlyingCode(of error: any Error) -> POSIXErrorCode? {
    let underlying = (error as NSError).userInfo[NSUnderlyingErrorKey] as? any Error
    if let code = (underlying as? POSIXError)?.code { return code }
    guard let number = underlying.map({ $0 as NSError }), number.domain == NSPOSIXErrorDomain
    else { return nil }
    return POSIXErrorCode(rawValue: Int32(truncatingIfNeeded: number.code))
  }
}

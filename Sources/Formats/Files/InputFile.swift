import Foundation

/// A file that is read from its beginning into memory that the caller owns.
package struct InputFile: ~Copyable {
  private let descriptor: Int32
  package let byteCount: Int

  /// Nil where there is no regular file that may be read.
  package init?(_ url: URL) {
    descriptor = open(url.path, O_RDONLY | O_CLOEXEC)
    guard descriptor >= 0 else { return nil }
    var information = stat()
    guard fstat(descriptor, &information) == 0, information.st_mode & S_IFMT == S_IFREG else {
      close(descriptor)
      return nil
    }
    byteCount = Int(information.st_size)
  }

  deinit { close(descriptor) }

  /// Fills `buffer` with the bytes that follow; false where there are fewer.
  package func read(into buffer: UnsafeMutableRawBufferPointer) -> Bool {
    var rest = buffer[...]
    while !rest.isEmpty {
      let count = Foundation.read(
        descriptor, UnsafeMutableRawBufferPointer(rebasing: rest).baseAddress, rest.count)
      if count < 0, errno == EINTR { continue }
      guard count > 0 else { return false }
      rest = rest.dropFirst(count)
    }
    return true
  }
}

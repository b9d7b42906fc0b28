import Foundation

/// A file for sequential reading into memory that the caller owns.
package struct InputFile: ~Copyable {
  private let descriptor: Int32
  /// Size of the whole file.
  package let byteCount: Int

  /// Nil unless `url` is a readable regular file.
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

  /// Fills `buffer` with the next bytes; false if there are too few.
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

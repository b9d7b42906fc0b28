import Foundation

/// A unique folder that is deleted when the value is released; hold the value while the folder is
/// in use.
package final class TemporaryFolder {
  package let url: URL

  package init() throws {
    url = FileManager.default.temporaryDirectory
      .appendingPathComponent("photogrammetry-\(UUID().uuidString)", isDirectory: true)
    try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
  }

  deinit { try? FileManager.default.removeItem(at: url) }

  /// Writes a file and returns its URL.
  @discardableResult
  package func write(_ bytes: [UInt8], as name: String) throws -> URL {
    let file = url.appendingPathComponent(name)
    try FileManager.default.createDirectory(
      at: file.deletingLastPathComponent(), withIntermediateDirectories: true)
    try Data(bytes).write(to: file)
    return file
  }

  /// Writes a text file and returns its URL.
  @discardableResult
  package func write(_ text: String, as name: String) throws -> URL {
    try write(Array(text.utf8), as: name)
  }
}

/// Runs a body with an empty folder that is removed afterward.
package func withTemporaryFolder<T>(_ body: (URL) throws -> T) throws -> T {
  let folder = try TemporaryFolder()
  defer { withExtendedLifetime(folder) {} }
  return try body(folder.url)
}

/// Runs a body with an empty folder that is removed afterward.
package func withTemporaryFolder<T>(
  isolation: isolated (any Actor)? = #isolation, _ body: (URL) async throws -> T
) async throws -> T {
  let folder = try TemporaryFolder()
  defer { withExtendedLifetime(folder) {} }
  return try await body(folder.url)
}

import Foundation

/// Runs a body with an empty folder that is removed afterward.
func withTemporaryFolder<T>(_ body: (URL) throws -> T) throws -> T {
  let url = try makeTemporaryFolder()
  defer { try? FileManager.default.removeItem(at: url) }
  return try body(url)
}

/// Runs a body with an empty folder that is removed afterward.
func withTemporaryFolder<T>(
  isolation: isolated (any Actor)? = #isolation, _ body: (URL) async throws -> T
) async throws -> T {
  let url = try makeTemporaryFolder()
  defer { try? FileManager.default.removeItem(at: url) }
  return try await body(url)
}

private func makeTemporaryFolder() throws -> URL {
  let url = FileManager.default.temporaryDirectory
    .appendingPathComponent("photogrammetry-\(UUID().uuidString)", isDirectory: true)
  try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
  return url
}

import Foundation

/// The bytes of a whole file. Throws `FormatError.unreadable`.
func contents(of url: URL) throws -> [UInt8] {
  do {
    return [UInt8](try Data(contentsOf: url))
  } catch {
    let exists = FileManager.default.fileExists(atPath: url.path)
    throw FormatError.unreadable(
      path: url.path, reason: exists ? error.localizedDescription : "it does not exist")
  }
}

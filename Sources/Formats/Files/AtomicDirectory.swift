import Foundation

/// Folders whose files appear together, after the last of them is complete.
package enum AtomicDirectory {
  /// Calls `body` with a new temporary folder, then renames it to `url`.
  ///
  /// If `url` already is a folder, files of the same name in it are replaced one by one, and all
  /// others stay. Throws `OutputError`, or what `body` throws; then nothing is left behind.
  package static func write(to url: URL, _ body: (URL) throws -> Void) throws {
    let destination = URL(fileURLWithPath: url.path, isDirectory: false)
    try AtomicFile.checkParent(of: destination)
    let exists = FileManager.default.fileExists(atPath: destination.path)
    if exists, !destination.isExistingFolder {
      throw OutputError.notAFolder(path: destination.path)
    }
    let temporary = AtomicFile.temporaryURL(for: destination)
    defer { try? FileManager.default.removeItem(at: temporary) }
    do {
      try FileManager.default.createDirectory(at: temporary, withIntermediateDirectories: false)
    } catch {
      throw AtomicFile.outputError(error, path: destination.path)
    }
    try body(temporary)
    do {
      if exists {
        try merge(temporary, into: destination)
      } else {
        try AtomicFile.rename(temporary, to: destination)
      }
    } catch {
      throw AtomicFile.outputError(error, path: destination.path)
    }
  }

  /// Moves every file of `source` to the same relative path below `destination`.
  private static func merge(_ source: URL, into destination: URL) throws {
    for name in try FileManager.default.contentsOfDirectory(atPath: source.path).sorted() {
      let from = source.appendingPathComponent(name)
      let to = destination.appendingPathComponent(name)
      if from.isExistingFolder {
        try FileManager.default.createDirectory(at: to, withIntermediateDirectories: true)
        try merge(from, into: to)
      } else {
        try AtomicFile.rename(from, to: to)
      }
    }
  }
}

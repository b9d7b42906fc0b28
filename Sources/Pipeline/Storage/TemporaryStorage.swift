import Foundation

/// Where temporary folders are created.
package enum TemporaryStorage {
  /// `TMPDIR` if set, else `/var/tmp`, the folder for large temporary files: `/tmp` is often in
  /// memory.
  package static var parent: URL {
    let large = "/var/tmp"
    let isChosen = ProcessInfo.processInfo.environment["TMPDIR"]?.isEmpty == false
    return !isChosen && FileManager.default.isWritableFile(atPath: large)
      ? URL(fileURLWithPath: large, isDirectory: true) : FileManager.default.temporaryDirectory
  }
}

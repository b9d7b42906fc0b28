import Foundation

/// Temporary files and folders of `AtomicFile` and `AtomicDirectory` whose writers were killed.
package enum UnfinishedFiles {
  /// What is younger, in seconds, may be written at this moment.
  static let minimumAge = 600.0

  /// Removes those in a folder: all, or those that were to become the file `name`.
  package static func remove(from folder: URL, of name: String? = nil) {
    let manager = FileManager.default
    let names = (try? manager.contentsOfDirectory(atPath: folder.path)) ?? []
    let start = name.map { AtomicFile.temporaryPrefix(of: $0) } ?? "."
    for name in names where name.hasPrefix(start) && name.hasSuffix(AtomicFile.temporarySuffix) {
      let path = folder.appendingPathComponent(name).path
      let date = (try? manager.attributesOfItem(atPath: path))?[.modificationDate] as? Date
      if let date, date.timeIntervalSinceNow < -minimumAge { try? manager.removeItem(atPath: path) }
    }
  }
}

import Foundation

/// Temporary files and folders of `AtomicFile` and `AtomicDirectory` left behind by killed
/// processes.
package enum UnfinishedFiles {
  /// Younger files, in seconds, may still be in use. Chosen.
  static let minimumAge = 600.0

  /// Removes those in a folder: all, or only those for the file `name`.
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

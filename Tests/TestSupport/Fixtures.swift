import Foundation

/// The photo sets in the repository's `Fixtures` folder.
package enum Fixtures {
  /// The folder of a set: `orbit`, `relief` or `bad`.
  package static func folder(_ set: String) -> URL {
    URL(fileURLWithPath: #filePath)
      .deletingLastPathComponent().deletingLastPathComponent().deletingLastPathComponent()
      .appendingPathComponent("Fixtures", isDirectory: true)
      .appendingPathComponent(set, isDirectory: true)
  }

  /// The photos of a rendered set.
  package static func images(of set: String) -> URL {
    folder(set).appendingPathComponent("images", isDirectory: true)
  }
}

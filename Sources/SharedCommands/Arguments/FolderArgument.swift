import Foundation

/// A folder on the command line.
package enum FolderArgument {
  /// The URL of the folder `path`, which should hold `content`; throws a `CommandFailure` unless
  /// `path` is a folder.
  package static func url(_ path: String, holding content: String) throws -> URL {
    let url = URL(fileURLWithPath: path, isDirectory: true)
    var isDirectory: ObjCBool = false
    guard FileManager.default.fileExists(atPath: url.path, isDirectory: &isDirectory) else {
      throw CommandFailure.usage("The folder \(path) does not exist. Check the path.")
    }
    guard isDirectory.boolValue else {
      throw CommandFailure.usage(
        "\(path) is a file. Name the folder that holds the \(content): \(parent(of: path))")
    }
    return url
  }

  /// The folder that holds `path`, in the user's notation.
  private static func parent(of path: String) -> String {
    let parent = (path as NSString).deletingLastPathComponent
    return parent.isEmpty ? "." : parent
  }
}

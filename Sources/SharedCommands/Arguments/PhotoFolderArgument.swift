import Foundation

/// A folder of photos, or of their masks, on the command line.
package struct PhotoFolderArgument {
  /// The location of the folder.
  package let url: URL

  /// Throws a `CommandFailure` unless `path` is a readable folder that isn't empty.
  package init(_ path: String, holding content: String = "photos") throws {
    url = try FolderArgument.url(path, holding: content)
    let names: [String]
    do {
      names = try FileManager.default.contentsOfDirectory(atPath: url.path)
    } catch {
      throw CommandFailure.usage("The folder \(path) can't be read. Check its permissions.")
    }
    guard names.contains(where: { !$0.hasPrefix(".") }) else {
      guard content == "photos" else {
        throw CommandFailure.usage("The folder \(path) is empty. It should hold the \(content).")
      }
      throw CommandFailure.run(
        "The folder \(path) is empty. Name a folder with photos (JPEG, HEIC or PNG) of one "
          + "object, taken all around it.")
    }
  }
}

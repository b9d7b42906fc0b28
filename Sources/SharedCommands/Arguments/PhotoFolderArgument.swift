import Foundation

/// A folder of photos, or of their masks, on the command line.
package struct PhotoFolderArgument {
  /// The location of the folder.
  package let url: URL

  /// Throws a `CommandFailure` unless `path` is a readable folder that isn't empty.
  package init(_ path: String, holding content: String = "photos") throws {
    url = URL(fileURLWithPath: path, isDirectory: true)
    var isDirectory: ObjCBool = false
    guard FileManager.default.fileExists(atPath: url.path, isDirectory: &isDirectory) else {
      throw CommandFailure.usage("The folder \(path) does not exist. Check the path.")
    }
    guard isDirectory.boolValue else {
      throw CommandFailure.usage(
        "\(path) is a file. Name the folder that holds the \(content): \(parent(of: path))")
    }
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

/// The folder that holds `path`, in the user's notation.
private func parent(of path: String) -> String {
  let parent = (path as NSString).deletingLastPathComponent
  return parent.isEmpty ? "." : parent
}

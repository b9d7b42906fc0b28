import Foundation

extension URL {
  /// Whether a folder exists at the path.
  package var isExistingFolder: Bool {
    var isDirectory: ObjCBool = false
    let exists = FileManager.default.fileExists(atPath: path, isDirectory: &isDirectory)
    return exists && isDirectory.boolValue
  }
}

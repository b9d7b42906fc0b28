/// A folder of photos, whose files are not read.
struct InputFolder {
  let url: URL

  init(_ url: URL) { self.url = url }

  var isUsable: Bool { fault == nil }

  /// Why the folder can't be used, in a sentence; nil if it can.
  var fault: String? {
    guard url.isFileURL else { return "\(url.absoluteString) is not on a disk of this machine." }
    var isDirectory: ObjCBool = false
    let files = FileManager.default
    guard files.fileExists(atPath: url.path, isDirectory: &isDirectory) else {
      return "The folder \(url.path) does not exist."
    }
    guard isDirectory.boolValue else { return "\(url.path) is a file and not a folder." }
    guard let visibleNames else { return "The folder \(url.path) can't be read." }
    return visibleNames.isEmpty ? "The folder \(url.path) is empty." : nil
  }

  /// The names in the folder that don't begin with a dot; nil if it can't be read.
  var visibleNames: [String]? {
    try? FileManager.default.contentsOfDirectory(atPath: url.path).filter { !$0.hasPrefix(".") }
  }
}

import Formats
import Foundation

/// Where the model goes; the path decides about the kind of output.
struct ModelOutput: Equatable {
  let url: URL
  let format: ModelFormat

  /// Understands `path`; throws a `CommandFailure` where nothing of the kind can be written.
  init(_ path: String) throws {
    let name = URL(fileURLWithPath: path, isDirectory: false)
    let named = ModelFormat(of: name)
    format = engineModelFiles.contains(named) ? named : .folder
    url = URL(fileURLWithPath: path, isDirectory: format == .folder)
    let fault = format == .folder ? Self.folderFault(path, name) : Self.fileFault(path)
    if let fault { throw CommandFailure.usage(fault) }
    try Self.checkWritable(url)
  }

  private static func fileFault(_ path: String) -> String? {
    if path.hasSuffix("/") {
      return "\(path) is named like a file but ends in a slash. Leave out the slash for a file, or "
        + "the suffix for a folder."
    }
    return isFolder(path) ? "\(path) is a folder. Choose another name for the model." : nil
  }

  private static func folderFault(_ path: String, _ name: URL) -> String? {
    if path.isEmpty { return "The output has no name." }
    // What "$name.usdz" becomes where the variable is empty.
    let isBareSuffix = ModelFormat.files.contains { name.lastPathComponent == ".\($0.rawValue)" }
    if isBareSuffix { return "\(path) has no name before its suffix." }
    if name.pathExtension.isEmpty || isFolder(path) || path.hasSuffix("/") { return nil }
    let files = engineModelFiles.map { ".\($0.rawValue)" }.joined(separator: " or ")
    return "Models are not written as .\(name.pathExtension) files. Name a \(files) file, or a "
      + "folder for OBJ, MTL, USDA and textures, with a slash at the end."
  }

  private static func isFolder(_ path: String) -> Bool {
    var isDirectory: ObjCBool = false
    let exists = FileManager.default.fileExists(atPath: path, isDirectory: &isDirectory)
    return exists && isDirectory.boolValue
  }

  /// Throws a `CommandFailure` unless a file or folder can be made at `url`.
  static func checkWritable(_ url: URL) throws {
    do {
      try AtomicFile.checkParent(of: URL(fileURLWithPath: url.path, isDirectory: false))
      if isFolder(url.path), !FileManager.default.isWritableFile(atPath: url.path) {
        throw OutputError.notWritable(path: url.path)
      }
      if url.hasDirectoryPath, FileManager.default.fileExists(atPath: url.path),
        !isFolder(url.path)
      {
        throw OutputError.notAFolder(path: url.path)
      }
    } catch {
      throw CommandFailure.usage(sentence(for: error))
    }
  }
}

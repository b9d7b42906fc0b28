import Formats
import Foundation

/// The file or folder of a model; the extension of its path selects the format.
package struct ModelOutput: Equatable, Sendable {
  /// The location; that of a folder has a directory path.
  package let url: URL
  /// The format that the extension selects.
  package let format: ModelFormat

  /// Parses `path`; throws a `CommandFailure` if no model can be written there in one of the file
  /// formats `formats` or as a folder.
  package init(_ path: String, formats: [ModelFormat]) throws {
    let name = URL(fileURLWithPath: path, isDirectory: false)
    let named = ModelFormat(of: name)
    format = formats.contains(named) ? named : .folder
    url = URL(fileURLWithPath: path, isDirectory: format == .folder)
    let fault =
      format == .folder ? Self.folderFault(path, name, formats) : Self.fileFault(path)
    if let fault { throw CommandFailure.usage(fault) }
    try Self.checkWritable(url)
  }

  /// The file of the same model at another level. Throws a `CommandFailure` if it can't be written.
  func atLevel(_ level: DetailArgument) throws -> ModelOutput {
    let path = url.relativePath as NSString
    let name = "\(path.deletingPathExtension)-\(level.rawValue).\(path.pathExtension)"
    return try ModelOutput(name, formats: [format])
  }

  private static func fileFault(_ path: String) -> String? {
    if path.hasSuffix("/") {
      return "\(path) is named like a file but ends in a slash. Omit the slash for a file, or "
        + "the extension for a folder."
    }
    return isFolder(path) ? "\(path) is a folder. Choose another name for the model." : nil
  }

  private static func folderFault(
    _ path: String, _ name: URL, _ formats: [ModelFormat]
  ) -> String? {
    if path.isEmpty { return "The output has no name. Name a file or folder for the model." }
    // What "$name.usdz" becomes if the variable is empty.
    let isBareExtension = ModelFormat.files.contains { name.lastPathComponent == ".\($0.rawValue)" }
    if isBareExtension {
      return "\(path) has no name before its extension. Name the model, for instance "
        + "model\(name.lastPathComponent)."
    }
    if name.pathExtension.isEmpty || isFolder(path) || path.hasSuffix("/") { return nil }
    let files = formats.map { ".\($0.rawValue)" }.joined(separator: " or ")
    return "Models can't be written as .\(name.pathExtension) files. Name a \(files) file, or a "
      + "folder for OBJ, MTL, USDA and textures, with a slash at the end."
  }

  private static func isFolder(_ path: String) -> Bool {
    var isDirectory: ObjCBool = false
    let exists = FileManager.default.fileExists(atPath: path, isDirectory: &isDirectory)
    return exists && isDirectory.boolValue
  }

  /// Throws a `CommandFailure` unless a file or folder can be written at `url`.
  package static func checkWritable(_ url: URL) throws {
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
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
  }
}

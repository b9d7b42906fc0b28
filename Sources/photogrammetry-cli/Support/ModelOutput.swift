import Foundation
import Formats

/// Where the model goes; the path decides about the kind of output.
enum ModelOutput: Equatable {
  /// One USDZ file.
  case file(URL)
  /// A folder with OBJ, MTL, USDA and textures.
  case folder(URL)

  var url: URL {
    switch self {
    case .file(let url), .folder(let url): url
    }
  }

  /// Understands `path`; throws a `CommandFailure` where nothing of the kind can be written.
  init(_ path: String) throws {
    let suffix = (path as NSString).pathExtension.lowercased()
    let exists = Self.isFolder(path)
    switch suffix {
    case "usdz" where !path.hasSuffix("/"):
      if exists {
        throw CommandFailure.usage("\(path) is a folder. Choose another name for the model.")
      }
      self = .file(URL(fileURLWithPath: path, isDirectory: false))
    case "" where true, _ where exists || path.hasSuffix("/"):
      self = .folder(URL(fileURLWithPath: path, isDirectory: true))
    case "glb", "gltf", "ply", "obj", "usd", "usda", "usdc":
      throw CommandFailure.usage(
        "Models are not written as .\(suffix). Name a .usdz file, or a folder for OBJ, MTL, USDA "
          + "and textures." + (suffix == "ply" ? " --point-cloud writes the points as PLY." : ""))
    default:
      throw CommandFailure.usage(
        "\(path) names neither a .usdz file nor a folder. For a folder, end it with a slash.")
    }
    try Self.checkWritable(url)
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

import Foundation
import ImageFiles
import SharedCommands

/// Recognizes a video on the command line.
enum VideoInput {
  /// What `path` names: a folder of photos, or a file that is not a photo. Throws a
  /// `CommandFailure` if it can't be used.
  static func input(_ path: String) throws -> PhotoInput {
    var isDirectory: ObjCBool = false
    let exists = FileManager.default.fileExists(atPath: path, isDirectory: &isDirectory)
    guard exists, !isDirectory.boolValue, !isPhoto(path) else {
      return .folder(try PhotoFolderArgument(path).url)
    }
    return .video(URL(fileURLWithPath: path))
  }

  /// Whether the content of a file is that of an image, whose folder was probably meant.
  private static func isPhoto(_ path: String) -> Bool {
    guard let file = FileHandle(forReadingAtPath: path),
      let start = try? file.read(upToCount: 1 << 16)
    else { return false }
    do {
      _ = try ImageHeader([UInt8](start))
      return true
    } catch ImageError.notAnImage {
      return false
    } catch {
      return true
    }
  }
}

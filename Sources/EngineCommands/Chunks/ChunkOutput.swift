import Foundation
import Kernels

/// A file that a chunk made, as it was when the chunk was done.
struct ChunkOutput: Codable, Equatable, Sendable {
  var path: String
  var bytes: Int
  /// XXH64 of the content, as 16 hexadecimal digits.
  var hash: String

  /// Reads the files at `paths`, and those in folders; those that don't exist are left out.
  static func all(at paths: [String]) -> [ChunkOutput] {
    paths.flatMap(files).compactMap(ChunkOutput.init(reading:))
  }

  /// Reads a file; nil if there is none.
  private init?(reading path: String) {
    guard
      let content = try? Data(contentsOf: URL(fileURLWithPath: path), options: .alwaysMapped)
    else { return nil }
    (self.path, bytes) = (path, content.count)
    hash = content.withUnsafeBytes { XXHash64.hash($0) }.hexadecimalDigits
  }

  private static func files(at path: String) -> [String] {
    var isFolder: ObjCBool = false
    guard FileManager.default.fileExists(atPath: path, isDirectory: &isFolder), isFolder.boolValue
    else { return [path] }
    // `subpathsOfDirectory` does not follow a symbolic link.
    let folder = URL(fileURLWithPath: path).resolvingSymlinksInPath()
    let names = (try? FileManager.default.subpathsOfDirectory(atPath: folder.path)) ?? []
    return names.sorted().map { path + "/" + $0 }.filter { file in
      var isFolder: ObjCBool = false
      return FileManager.default.fileExists(atPath: file, isDirectory: &isFolder)
        && !isFolder.boolValue
    }
  }

  /// Whether the file has its size still.
  var isThere: Bool {
    let size = try? FileManager.default.attributesOfItem(atPath: path)[.size] as? NSNumber
    return size?.intValue == bytes
  }

  /// Whether the file has its content still: the write of a machine that died may be lost although
  /// the file has its size.
  var isIntact: Bool { ChunkOutput(reading: path) == self }
}

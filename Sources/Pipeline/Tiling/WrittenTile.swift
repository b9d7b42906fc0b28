import Foundation
import Kernels

/// The record of a tile whose model was written.
struct WrittenTile: Codable, UnitValue {
  /// Nil if the tile has no surface, and no file.
  var tile: TileIndex.Tile?
  /// The XXH64 hash of the file.
  var hash: UInt64 = 0

  /// Whether the file in a folder is the one that was written.
  func isIntact(in folder: URL) -> Bool {
    guard let tile else { return true }
    return Self.hash(of: folder.appendingPathComponent(tile.file)) == hash
  }

  /// The hash of a file; nil if it can't be read.
  static func hash(of file: URL) -> UInt64? {
    (try? Data(contentsOf: file, options: .alwaysMapped))?.withUnsafeBytes { XXHash64.hash($0) }
  }
}

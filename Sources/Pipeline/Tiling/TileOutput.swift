import Foundation
import Formats
import SceneModel

/// Where the tiles of a scene are written, and how.
package struct TileOutput: Hashable, Codable, Sendable {
  /// Receives a model file for each tile, and `tiles.json`.
  package var folder: URL
  /// `usdz` or `glb`.
  package var fileExtension: String

  package init(folder: URL, fileExtension: String) {
    (self.folder, self.fileExtension) = (folder, fileExtension)
  }

  /// The file of a tile, by its number from 1.
  func file(_ number: Int) -> URL {
    folder.appendingPathComponent(String(format: "tile-%04d.", number) + fileExtension)
  }

  /// Creates the folder, and removes the index of an earlier run and its tiles, except some. Throws
  /// `OutputError`.
  func prepare(keeping kept: Set<String>) throws {
    do {
      try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    } catch {
      throw OutputError.notWritable(path: folder.path)
    }
    guard let data = try? Data(contentsOf: index),
      let earlier = try? JSONDecoder().decode(TileIndex.self, from: data)
    else { return }
    try? FileManager.default.removeItem(at: index)
    for file in earlier.tiles.map(\.file) where !file.contains("/") && !kept.contains(file) {
      try? FileManager.default.removeItem(at: folder.appendingPathComponent(file))
    }
  }

  private var index: URL { folder.appendingPathComponent("tiles.json") }

  /// Writes the index, when all tiles are there.
  func write(_ index: TileIndex) throws {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    try AtomicFile.write(try encoder.encode(index), to: self.index)
  }
}

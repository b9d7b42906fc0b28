import Formats
import Foundation
import Kernels
import SceneModel

/// The points in and around each tile, in files of a folder. A point near a seam is in several.
struct TilePoints {
  private let grid: TileGrid
  private let folder: URL
  private let reaches: [CellBox]
  /// The tiles whose reach has a cell.
  private var tilesOfCell: [SIMD3<Int32>: [Int]] = [:]
  private var pending: [PointCloud]
  /// The number of files of each tile.
  private var fileCounts: [Int]

  /// Points of a file. Chosen: a few megabytes.
  private static let blockSize = 50_000

  /// `reach` is the number of cells by which tiles reach beyond their boxes.
  init(_ grid: TileGrid, reach: Int, in folder: URL) {
    self.grid = grid
    self.folder = folder
    reaches = grid.boxes.map { $0.dilated(by: reach) }
    pending = grid.boxes.map { _ in PointCloud() }
    fileCounts = grid.boxes.map { _ in 0 }
  }

  /// Adds points in the order in which they are to be read. Throws `OutputError`.
  mutating func add(_ cloud: PointCloud) throws {
    for (index, position) in cloud.positions.enumerated() {
      for tile in tiles(at: position) { pending[tile].append(cloud, index) }
    }
    for tile in pending.indices where pending[tile].count >= Self.blockSize { try write(tile) }
  }

  /// The points of a tile. Throws `WorkspaceError` if a file was changed or deleted.
  func points(of tile: Int) throws -> PointCloud {
    var cloud = PointCloud()
    for number in 0..<fileCounts[tile] {
      let url = file(tile, number)
      guard let data = try? Data(contentsOf: url), cloud.append(encoded: [UInt8](data)[...]) else {
        throw WorkspaceError.changed(file: url.path)
      }
    }
    cloud.append(pending[tile])
    return cloud
  }

  private mutating func tiles(at position: SIMD3<Float>) -> [Int] {
    guard let cell = grid.cube.cell(of: position, depth: grid.depth) else { return [] }
    if let known = tilesOfCell[cell] { return known }
    let found = reaches.indices.filter { reaches[$0].contains(cell) }
    tilesOfCell[cell] = found
    return found
  }

  private func file(_ tile: Int, _ number: Int) -> URL {
    folder.appendingPathComponent("\(tile)-\(number).points")
  }

  private mutating func write(_ tile: Int) throws {
    try AtomicFile.write(pending[tile].encoded(), to: file(tile, fileCounts[tile]))
    pending[tile] = PointCloud()
    fileCounts[tile] += 1
  }
}

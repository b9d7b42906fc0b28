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

  /// Points of a tile that are collected before they are written. Chosen: a few megabytes.
  private static let blockSize = 50_000

  /// `reach` is the number of cells by which tiles reach beyond their boxes.
  init(_ grid: TileGrid, reach: Int, in folder: URL) {
    self.grid = grid
    self.folder = folder
    reaches = grid.boxes.map { $0.dilated(by: reach) }
    pending = grid.boxes.map { _ in PointCloud() }
  }

  /// Adds points in the order in which they are to be read.
  mutating func add(_ cloud: PointCloud) throws {
    for (index, position) in cloud.positions.enumerated() {
      for tile in tiles(at: position) { pending[tile].append(cloud, index) }
    }
    for tile in pending.indices where pending[tile].count >= Self.blockSize { try write(tile) }
  }

  /// Writes what is left. Called once, before the points are read.
  mutating func finish() throws { for tile in pending.indices { try write(tile) } }

  /// The points of a tile.
  func points(of tile: Int) throws -> PointCloud {
    var cloud = PointCloud()
    var rest = [UInt8](try Data(contentsOf: file(tile)))[...]
    while rest.count >= 8 {
      let count = rest.withUnsafeBytes { Int($0.loadUnaligned(as: UInt64.self)) }
      guard count <= rest.count - 8, cloud.append(encoded: rest.dropFirst(8).prefix(count)) else {
        throw WorkspaceError.changed(file: file(tile).path)
      }
      rest = rest.dropFirst(8 + count)
    }
    return cloud
  }

  private mutating func tiles(at position: SIMD3<Float>) -> [Int] {
    let depth = grid.boxes.first?.depth ?? 0
    guard let cell = grid.cube.cell(of: position, depth: depth) else { return [] }
    if let known = tilesOfCell[cell] { return known }
    let found = reaches.indices.filter { reaches[$0].contains(cell) }
    tilesOfCell[cell] = found
    return found
  }

  private func file(_ tile: Int) -> URL { folder.appendingPathComponent("\(tile).points") }

  private mutating func write(_ tile: Int) throws {
    let bytes = pending[tile].encoded()
    pending[tile] = PointCloud()
    if !FileManager.default.fileExists(atPath: file(tile).path) {
      try Data().write(to: file(tile))
    }
    let handle = try FileHandle(forWritingTo: file(tile))
    try handle.seekToEnd()
    try handle.write(contentsOf: withUnsafeBytes(of: UInt64(bytes.count)) { Data($0) } + bytes)
    try handle.close()
  }
}

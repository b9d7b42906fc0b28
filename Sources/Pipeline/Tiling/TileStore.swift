import Foundation
import Kernels
import SceneModel

/// What is made of tiles, in a folder: a later run, or another process, finds it there.
struct TileStore: Sendable {
  private let units: UnitStore
  /// For what only other processes read.
  private let shared: UnitStore
  /// The fingerprint of everything that tiles' surfaces, and what lies around them, depend on.
  private let inputs: UInt64

  /// `isShared` says whether other processes or runs may read the folder.
  init(folder: URL, isShared: Bool, inputs: UInt64) {
    units = UnitStore(folder: folder, isWritten: true)
    shared = UnitStore(folder: folder, isWritten: isShared)
    self.inputs = inputs
  }

  /// Whether other processes or runs may read the folder.
  var isShared: Bool { shared.isWritten }

  /// The base that was stored; nil if there is none.
  var base: TileBase? { shared.find(.tileBase, madeFrom: inputs) }
  /// The points that were stored and prove that space is free; nil if there are none.
  var observed: PointCloud? { shared.find(.observed, madeFrom: inputs) }

  /// What was stored that lies around tiles; nil if a part of it is missing.
  var surroundings: TileSurroundings? {
    guard let occluders: OccluderRecord = shared.find(.occluders, madeFrom: inputs) else {
      return nil
    }
    return observed.map { TileSurroundings(observed: $0, occluders) }
  }

  /// Stores what tiles and the surface of the scene are made from. Throws `OutputError`.
  func save(_ base: TileBase, observed: PointCloud) throws {
    try shared.save(base, .tileBase, madeFrom: inputs)
    try shared.save(observed, .observed, madeFrom: inputs)
  }

  /// Stores what hides tiles from photos, and the photos' gains on it. Throws `OutputError`.
  func save(_ occluders: OccluderRecord) throws {
    try shared.save(occluders, .occluders, madeFrom: inputs)
  }

  /// The samples of the scene near a tile, stored or from `make`.
  func samples(_ tile: Int, _ make: () throws -> NearbySamples) throws -> NearbySamples {
    try shared.value(.tileSamples, madeFrom: key(tile), make)
  }

  /// The solution of a tile, stored or from `make`.
  func solved(_ tile: Int, _ make: () throws -> SolvedTile) throws -> SolvedTile {
    try units.value(.solvedTile, madeFrom: key(tile), make)
  }

  /// What is known of the model of a tile that depends on `options` besides; nil if it was not
  /// made.
  func written(_ tile: Int, options: UInt64) -> WrittenTile? {
    units.find(.writtenTile, madeFrom: key(tile, options))
  }

  /// Stores that the model of a tile was written. Throws `OutputError`.
  func save(_ written: WrittenTile, _ tile: Int, options: UInt64) throws {
    try units.save(written, .writtenTile, madeFrom: key(tile, options))
  }

  private func key(_ tile: Int, _ options: UInt64 = 0) -> UInt64 {
    var key = Fingerprint()
    key.add(inputs)
    key.add(tile)
    key.add(options)
    return key.value
  }
}

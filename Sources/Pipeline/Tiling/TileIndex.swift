import SceneModel

/// What a folder of tiles holds: `tiles.json`.
struct TileIndex: Codable, Sendable {
  /// A tile, in the frame of the models.
  struct Tile: Codable, Sendable {
    /// Its file, in the folder of the index.
    var file: String
    /// The box around its surface.
    var minimum: [Float]
    var maximum: [Float]
    var triangles: Int
    /// The number of photos that show it.
    var photos: Int
  }

  var version = 1
  /// Whether lengths are in meters; else their unit is arbitrary.
  var isMetric: Bool
  var tiles: [Tile] = []
}
